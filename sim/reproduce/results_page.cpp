#include "sim/reproduce/results_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

constexpr const char* kHowToRead =
    R"(Each row is a claim: the paper's figure, what Hedgehop's developers ask of ours ("asked": no paper's demand), the law as
the paper prints it ("as printed") and ours on the same seeds. Ours flies the sensors `day`; `ideal` and `dull` stand beside it and decide
nothing. A row holds only when every flight that was asked for was flown without a fault and has the figure, unless
the row says what a missing one means; a row that allows no contact needs its flights to finish, too. Judging seeds are none
that parameters were chosen on (`tuned_on` in `configs/papers/`). Intervals are Wilson's at 95 % [Wilson1927] p. 212, of shares and
counts alone.

Figures of vehicles, cameras, images and exports are in [verification.md](verification.md), those of speed in
[performance.md](performance.md), what fails in [known-failures.md](known-failures.md), what is not modeled in
[limits.md](limits.md).
)";

}  // namespace

PageFacts page_facts(const RowsOfPapers& papers, const std::string& packages, bool quick) {
  PageFacts facts{.version = std::string(version()),
                  .build = std::string(build_identity()),
                  .packages = packages,
                  .builds = {},
                  .quick = quick};
  for (const auto& [paper, rows] : papers) {
    for (const RowOutcome& row : rows) facts.builds.insert(row.builds.begin(), row.builds.end());
  }
  return facts;
}

std::string several_builds_line(const PageFacts& facts) {
  if (facts.builds.size() < 2) return "";
  return fmt::format("Rows of {} builds: {}", facts.builds.size(), fmt::join(facts.builds, ", "));
}

std::string results_page(const RowsOfPapers& papers, const PageFacts& facts) {
  std::string text;
  if (const std::string several = several_builds_line(facts); !several.empty()) text += "**" + several + "**\n\n";
  text += fmt::format("# Results\n\nBuild `{}`, Hedgehop {}, {}. Written by\n\n", facts.build, facts.version,
                      facts.packages);
  text += "```sh\nhedgehop reproduce";
  for (const auto& [paper, rows] : papers) text += " " + paper.key;
  text += " --write docs/results.md\n```\n\n";
  if (facts.quick) text += "**A quick look: few seeds were flown.**\n\n";
  text += kHowToRead;
  for (const auto& [paper, rows] : papers) text += "\n" + rows_text(paper, rows);
  return text;
}

}  // namespace hedgehop::sim
