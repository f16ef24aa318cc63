#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/reproduce/paper_row.h"

namespace hedgehop::sim {

/// Origin of a page of results.
struct PageFacts {
  std::string version, build;       ///< of the program that writes it
  std::string commit;               ///< of its sources; empty if unknown
  std::string packages;             ///< those that figures depend on, with versions: "OpenCV 4.6.0, SLEEF 3.5.1"
  std::set<std::string> builds;     ///< of all rows
  std::set<std::string> renderers;  ///< of all flights: "renderer tiles", "renderer Mesa 22.3.6"
  bool quick = false;               ///< whether only few seeds were flown
};

/// Note above the rows of a quick run, in Markdown.
inline constexpr std::string_view kQuickRun =
    "**Quick run: only a few seeds of each row were flown. They show that everything runs, not that a claim holds. "
    "The commands fly all seeds.**\n";

/// Returns the origin of rows: `version` and `build` of this program, and the builds of all rows.
PageFacts page_facts(const RowsOfPapers& papers, const std::string& packages, bool quick,
                     std::set<std::string> renderers = {});

/// Returns the renderers and packages, separated by commas.
std::string package_words(const PageFacts& facts);

/// Returns " of commit 44e015e", or "" if it is unknown.
std::string of_commit(const PageFacts& facts);

/// Returns "Rows of 2 builds: a, b", or "" if all rows are of one build.
std::string several_builds_line(const PageFacts& facts);

/// Returns the page docs/results.md in Markdown, without a date: the builds if there are several, the origin, an
/// explanation, and the rows of each paper in the order of the keys. `earlier` is the page that this one replaces; its
/// other papers are kept if its build, commit, version and packages are equal. The origin names the renderers of both.
std::string results_page(const RowsOfPapers& papers, const PageFacts& facts, const std::string& earlier = "");

/// Returns the headings of the sections of an earlier page that a page lacks.
std::vector<std::string> dropped_sections(const std::string& earlier, const std::string& page);

}  // namespace hedgehop::sim
