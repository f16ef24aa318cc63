#include "sim/reproduce/results_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kCommand = "```sh\nhedgehop reproduce";
constexpr std::string_view kOption = " --write docs/results.md\n```\n\n";
constexpr std::string_view kHeading = "\n## ";

constexpr const char* kHowToRead =
    R"(Each row is a claim: the paper's figure, the requirement of Hedgehop's developers (no paper states it), the published law, and the
modified law. Both fly the same seeds; if the modified law flies 100, the published law flies the first 50. The modified law flies
with the sensors `day`; `ideal` and `dull` are for comparison only. A row holds if every required flight was flown without a fault and
has the figure, unless the row gives another meaning to a missing figure. A row that allows no contact also requires its flights to
finish. No parameter was chosen on the judging seeds (`tuned_on` in `configs/papers/`). Intervals are Wilson's at 95 % [Wilson1927]
p. 212, of shares and counts only.

Other pages have the figures of vehicles, cameras, images and exports ([verification.md](verification.md)), speed
([performance.md](performance.md)), failures ([known-failures.md](known-failures.md)) and effects that are not modeled
([limits.md](limits.md)).
)";

/// The section of each paper, by key.
using Sections = std::map<std::string, std::string>;

/// Returns the sections of a page without its origin; empty if the numbers of keys in the command and sections differ.
Sections sections_of(std::string_view page) {
  const size_t option = page.find(kOption);
  if (!page.starts_with(kCommand) || option == std::string_view::npos) return {};
  std::istringstream keys{std::string(page.substr(kCommand.size(), option - kCommand.size()))};
  Sections sections;
  size_t begin = page.find(kHeading);
  for (std::string key; keys >> key && begin != std::string_view::npos;) {
    const size_t end = page.find(kHeading, begin + 1);
    sections[key] = page.substr(begin, end - begin);
    begin = end;
  }
  return begin == std::string_view::npos && !keys ? sections : Sections{};
}

/// Returns the origin up to its renderers.
std::string origin_begin(const PageFacts& facts) {
  const std::string several = several_builds_line(facts);
  return fmt::format("{}# Results\n\nBuild `{}`{}, Hedgehop {}, ", several.empty() ? "" : "**" + several + "**\n\n",
                     facts.build, of_commit(facts), facts.version);
}

/// Returns the origin after its renderers.
std::string origin_end(const PageFacts& facts) { return facts.packages + ". Written by\n\n"; }

struct KeptPage {
  std::set<std::string> renderers;
  Sections sections;
};

/// Returns the content of an earlier page; empty if its build, commit, version or packages differ.
KeptPage kept_of(const std::string& earlier, const PageFacts& facts) {
  constexpr std::string_view kComma = ", ", kNext = ", renderer ";
  const std::string begin = origin_begin(facts), end = origin_end(facts);
  if (facts.quick || !earlier.starts_with(begin)) return {};
  const size_t at = earlier.find(end, begin.size());
  if (at == std::string::npos) return {};
  const std::string_view renderers = std::string_view(earlier).substr(begin.size(), at - begin.size());
  if (!renderers.empty() && !(renderers.starts_with(kNext.substr(kComma.size())) && renderers.ends_with(kComma)))
    return {};
  KeptPage kept{.renderers = {}, .sections = sections_of(std::string_view(earlier).substr(at + end.size()))};
  for (size_t first = 0; first < renderers.size();) {
    const size_t last = std::min(renderers.find(kNext, first), renderers.size() - kComma.size());
    kept.renderers.emplace(renderers.substr(first, last - first));
    first = last + kComma.size();
  }
  return kept;
}

std::vector<std::string> headings_of(const std::string& page) {
  std::vector<std::string> headings;
  for (size_t at = page.find(kHeading); at != std::string::npos; at = page.find(kHeading, at + 1)) {
    const size_t begin = at + kHeading.size();
    headings.push_back(page.substr(begin, page.find('\n', begin) - begin));
  }
  return headings;
}

}  // namespace

PageFacts page_facts(const RowsOfPapers& papers, const std::string& packages, bool quick,
                     std::set<std::string> renderers) {
  PageFacts facts{.version = std::string(version()),
                  .build = std::string(build_identity()),
                  .commit = std::string(build_commit()),
                  .packages = packages,
                  .builds = {},
                  .renderers = std::move(renderers),
                  .quick = quick};
  for (const auto& [paper, rows] : papers) {
    for (const RowOutcome& row : rows) facts.builds.insert(row.builds.begin(), row.builds.end());
  }
  return facts;
}

std::string of_commit(const PageFacts& facts) {
  return facts.commit.empty() ? "" : fmt::format(" of commit {}", facts.commit);
}

std::string several_builds_line(const PageFacts& facts) {
  if (facts.builds.size() < 2) return "";
  return fmt::format("Rows of {} builds: {}", facts.builds.size(), fmt::join(facts.builds, ", "));
}

std::string package_words(const PageFacts& facts) {
  std::string words;
  for (const std::string& renderer : facts.renderers) words += renderer + ", ";
  return words + facts.packages;
}

std::string results_page(const RowsOfPapers& papers, const PageFacts& facts, const std::string& earlier) {
  KeptPage page = kept_of(earlier, facts);
  for (const auto& [paper, rows] : papers) page.sections.erase(paper.key);
  PageFacts all = facts;
  if (!page.sections.empty()) all.renderers.merge(page.renderers);
  for (const auto& [paper, rows] : papers) page.sections[paper.key] = "\n" + rows_text(paper, rows);
  std::string text = origin_begin(facts) + package_words(all) + origin_end(facts).substr(facts.packages.size());
  text += kCommand;
  for (const auto& [key, section] : page.sections) text += " " + key;
  text += std::string(kOption) + (facts.quick ? std::string(kQuickRun) + "\n" : "") + kHowToRead;
  for (const auto& [key, section] : page.sections) text += section;
  return text;
}

std::vector<std::string> dropped_sections(const std::string& earlier, const std::string& page) {
  std::vector<std::string> dropped = headings_of(earlier);
  const std::vector<std::string> left = headings_of(page);
  std::erase_if(dropped, [&](const std::string& heading) { return std::ranges::find(left, heading) != left.end(); });
  return dropped;
}

}  // namespace hedgehop::sim
