#include "sim/reproduce/results_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <sstream>
#include <string_view>

#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kCommand = "```sh\nhedgehop reproduce";
constexpr std::string_view kOption = " --write docs/results.md\n```\n\n";
constexpr std::string_view kHeading = "\n## ";

constexpr const char* kHowToRead =
    R"(Each row is a claim: the paper's figure, the requirement of Hedgehop's developers (no paper states it), the published law, and the
modified law on the same seeds. The modified law flies with the sensors `day`; `ideal` and `dull` are for comparison only. A row holds
if every required flight was flown without a fault and has the figure, unless the row gives another meaning to a missing figure. A row
that allows no contact also requires its flights to finish. No parameter was chosen on the judging seeds (`tuned_on` in
`configs/papers/`). Intervals are Wilson's at 95 % [Wilson1927] p. 212, of shares and counts only.

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

std::string origin_text(const PageFacts& facts) {
  const std::string several = several_builds_line(facts);
  return fmt::format("{}# Results\n\nBuild `{}`{}, Hedgehop {}, {}. Written by\n\n",
                     several.empty() ? "" : "**" + several + "**\n\n", facts.build, of_commit(facts), facts.version,
                     facts.packages);
}

}  // namespace

PageFacts page_facts(const RowsOfPapers& papers, const std::string& packages, bool quick) {
  PageFacts facts{.version = std::string(version()),
                  .build = std::string(build_identity()),
                  .commit = std::string(build_commit()),
                  .packages = packages,
                  .builds = {},
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

std::string results_page(const RowsOfPapers& papers, const PageFacts& facts, const std::string& earlier) {
  const std::string origin = origin_text(facts);
  Sections sections =
      earlier.starts_with(origin) && !facts.quick ? sections_of(earlier.substr(origin.size())) : Sections{};
  for (const auto& [paper, rows] : papers) sections[paper.key] = "\n" + rows_text(paper, rows);
  std::string text = origin + std::string(kCommand);
  for (const auto& [key, section] : sections) text += " " + key;
  text += std::string(kOption) + (facts.quick ? std::string(kQuickRun) + "\n" : "") + kHowToRead;
  for (const auto& [key, section] : sections) text += section;
  return text;
}

}  // namespace hedgehop::sim
