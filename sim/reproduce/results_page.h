#pragma once

#include <set>
#include <string>
#include <string_view>

#include "sim/reproduce/paper_row.h"

namespace hedgehop::sim {

/// What a page of papers' figures says of its origin.
struct PageFacts {
  std::string version, build;    ///< of the program that writes it
  std::string commit;            ///< of its sources; empty where that is not known
  std::string packages;          ///< those that figures depend on, with versions: "Mesa 22.3.6, OpenCV 4.6.0"
  std::set<std::string> builds;  ///< of all rows
  bool quick = false;            ///< few seeds were flown
};

/// What stands above rows of a quick look, in Markdown.
inline constexpr std::string_view kQuickLook =
    "**A quick look: of each row a few seeds were flown, which show that all runs, not that a claim holds. The "
    "commands fly all seeds.**\n";

/// The facts of rows: `version` and `build` of this program, the builds of all rows.
PageFacts page_facts(const RowsOfPapers& papers, const std::string& packages, bool quick);

/// " of commit 44e015e", or "" where it is not known.
std::string of_commit(const PageFacts& facts);

/// "Rows of 2 builds: a, b", or "" where all rows are of one.
std::string several_builds_line(const PageFacts& facts);

/// The page as docs/results.md has it, in Markdown, without a date: the builds where there are several, the origin, how
/// to read it, and each paper's rows, papers in the order of their keys. The other papers of `earlier`, the page that
/// this one takes the place of, stay where its build, commit, version and packages are these.
std::string results_page(const RowsOfPapers& papers, const PageFacts& facts, const std::string& earlier = "");

}  // namespace hedgehop::sim
