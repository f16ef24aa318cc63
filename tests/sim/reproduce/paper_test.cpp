#include "sim/reproduce/paper.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sim/batch/seeds.h"
#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/reproduce/calculations.h"
#include "sim/reproduce/outcome.h"
#include "sim/sweep/sweep_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::filesystem::path kPapers = HEDGEHOP_SOURCE_DIR "/configs/papers";

std::vector<std::string> faults_of(const std::string& text, const std::string& tuned_on = "tuned_on: none\n") {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "paper.yaml", "title: A\nsource: B\n" + tuned_on + text);
  try {
    read_paper(folder.path() / "paper.yaml");
  } catch (const InputError& error) {
    return error.errors();
  }
  return {};
}

TEST(PaperFile, EveryShippedOneCanBeFlown) {
  int papers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kPapers)) {
    const Paper paper = read_paper(entry.path());
    std::set<std::string> all, quick;
    for (const Order& order : paper_orders(paper, false)) EXPECT_TRUE(all.insert(order.id).second) << order.id;
    for (const Order& order : paper_orders(paper, true)) quick.insert(order.id);
    EXPECT_TRUE(std::ranges::includes(all, quick)) << paper.key << ": a quick run must be part of the full run";
    ++papers;
  }
  EXPECT_GE(papers, 2);
}

TEST(PaperFile, SourcesAreListedInTheReferences) {
  const std::string references = read_file_whole(HEDGEHOP_SOURCE_DIR "/REFERENCES.md");
  for (const auto& entry : std::filesystem::directory_iterator(kPapers)) {
    EXPECT_THAT(references, HasSubstr("[" + read_paper(entry.path()).source + "]"));
  }
}

TEST(PaperFile, UnknownNamesAreRefusedWithTheirPlace) {
  const std::string flights = "flights: [{scenario: a.yaml, seeds: '1:2'}]\n";
  EXPECT_THAT(faults_of(flights + "rows: [{claim: w, flights: [b], column: outcome, is: x, statistic: count}]"),
              Contains(AllOf(HasSubstr("paper.yaml:5"), HasSubstr("no flights are called 'b'"))));
  EXPECT_THAT(faults_of("rows: [{claim: w, calculation: none, value: x}]"), Contains(HasSubstr("section_costs")));
  EXPECT_THAT(faults_of("rows: [{claim: w, calculation: section_costs, value: x}]"), Contains(HasSubstr("cost_ms")));
  EXPECT_THAT(faults_of("charts: [{title: t, series: [{from: log, label: l, flights: c, y: d}]}]"),
              Contains(HasSubstr("no flights are called 'c'")));
}

TEST(PaperFile, FormerKeysAreRejectedWithTheirNewNames) {
  const std::string flights = "flights: [{scenario: a.yaml, seeds: '1:2', ";
  EXPECT_THAT(faults_of(flights + "printed: [law=published]}]"), Contains(HasSubstr("its name is now 'published'")));
  EXPECT_THAT(faults_of(flights + "beside: '1'}]"), Contains(HasSubstr("its name is now 'sensor_seeds'")));
  const auto of_claim = faults_of("rows: [{what: w, calculation: section_costs, value: x}]");
  EXPECT_THAT(of_claim, Contains(HasSubstr("its name is now 'claim'")));
  EXPECT_THAT(of_claim, Not(Contains(HasSubstr("missing key 'claim'"))));
  EXPECT_THAT(faults_of(flights + "published: [law=published]}]\ncharts: [{title: t, series: [{from: log, label: l, "
                                  "flights: a/printed, y: d}]}]"),
              Contains(HasSubstr("no flights are called 'a/printed'; their name is now 'a/published'")));
  EXPECT_THAT(faults_of("rows: [{claim: w, flights: [a], column: wall_s, statistic: least}]"),
              Contains(HasSubstr("its name is now 'min'")));
  EXPECT_THAT(faults_of("charts: [{title: t, series: [{from: groups, label: l, x: [1], flights: [a], column: wall_s, "
                        "statistic: greatest}]}]"),
              Contains(HasSubstr("its name is now 'max'")));
}

TEST(PaperFile, ContradictionsAreRefused) {
  const std::string flights = "flights: [{scenario: a.yaml, seeds: '1:2'}]\n";
  EXPECT_THAT(faults_of("rows: [{claim: w}]"), Contains(HasSubstr("either 'flights' or 'calculation'")));
  EXPECT_THAT(faults_of("flights: [{scenario: a.yaml, seeds: '2:1'}]"), Contains(HasSubstr("2:1")));
  EXPECT_THAT(faults_of("flights: [{scenario: a.yaml, seeds: '1'}, {scenario: a.yaml, seeds: '2'}]"),
              Contains(HasSubstr("two flights are called 'a'")));
  EXPECT_THAT(faults_of(flights + "rows: [{claim: w, flights: [a], column: outcome, statistic: count}]"),
              Contains(HasSubstr("needs 'is'")));
  for (const std::string statistic : {"count", "share"}) {
    EXPECT_THAT(
        faults_of(flights + "rows: [{claim: w, flights: [a], column: outcome, is: reached, unit: '%', statistic: " +
                  statistic + "}]"),
        Contains(HasSubstr("'%' is not valid with count and share")));
  }
  EXPECT_THAT(faults_of("charts: [{title: t, series: [{from: points, label: l, x: [1, 2], y: [1]}]}]"),
              Contains(HasSubstr("2 x values, but 1 y values")));
  EXPECT_THAT(faults_of(flights + "charts: [{title: t, series: [{from: paths, label: l, flights: a}, "
                                  "{from: points, label: p, x: [], y: []}]}]"),
              Contains(HasSubstr("cannot share a chart")));
}

TEST(PaperFile, TuningSeedsAreRefusedAsJudgingSeeds) {
  const auto faults = [](const std::string& text) { return faults_of(text, ""); };
  EXPECT_THAT(faults("flights: [{scenario: a.yaml, seeds: 1:2}]"), Contains(HasSubstr("missing key 'tuned_on'")));
  EXPECT_THAT(faults("tuned_on: 1:10\nflights: [{scenario: a.yaml, seeds: 10:12}]"),
              Contains(AllOf(HasSubstr("paper.yaml:4:"), HasSubstr("seed 10"))));
  EXPECT_THAT(faults("tuned_on: 1:10\nflights: [{scenario: a.yaml, seeds: 11:12}]"), IsEmpty());
  EXPECT_THAT(faults("tuned_on: 1:10\nflights: [{scenario: a.yaml, seeds: 11:12, tuned_on: 12}]"),
              Contains(HasSubstr("seed 12")));
  EXPECT_THAT(faults("tuned_on: 1:10\nflights: [{scenario: a.yaml, seeds: 11:12, quick: 12:13}]"),
              Contains(HasSubstr("'12:13' are not all")));
  const std::string published = "tuned_on: none\nflights: [{scenario: a.yaml, seeds: 1:9, published_seeds: ";
  EXPECT_THAT(faults(published + "9:10, published: [b=2]}]"), Contains(HasSubstr("'9:10' are not all")));
  EXPECT_THAT(faults(published + "1:3, published: [b=2], quick: 3:4}]"), Contains(HasSubstr("'3:4' are not all")));
  EXPECT_THAT(faults(published + "1:3}]"), Contains(HasSubstr("needs 'published'")));
}

TEST(PaperFile, VariantsFlyTheSameScenarioWithTheirOwnOverrides) {
  Paper paper{.folder = "configs/papers"};
  paper.flights = {{.name = "tree",
                    .scenario = "configs/deep/tree.yaml",
                    .seeds = "1001:1030",
                    .quick = "1001",
                    .set = {"a=1"},
                    .published = {"b=2"},
                    .published_seeds = "1001:1020",
                    .sensors = {"ideal", "dull"},
                    .sensor_seeds = "1001:1010"}};
  const std::vector<FlightGroup> groups = flight_groups(paper);
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[1].name, "tree/published");
  EXPECT_EQ(groups[1].seeds, "1001:1020");
  EXPECT_THAT(groups[1].set, ElementsAre("a=1", "b=2"));
  EXPECT_EQ(groups[3].name, "tree/dull");
  EXPECT_EQ(groups[3].seeds, "1001:1010");
  EXPECT_THAT(groups[3].set, ElementsAre("a=1", "rig.sensor.use=../sensors/dull.yaml"));
  EXPECT_FALSE(groups[3].quick);
}

// A sweep without `tuned_on` chooses no parameter: it judges, as the papers' flights do.
TEST(PaperFile, NoShippedFileJudgesOnASeedOfATuningSweep) {
  std::set<uint64_t> tuned, judged;
  for (const auto& entry : std::filesystem::directory_iterator(kPapers / "../sweeps")) {
    const SweepConfig sweep = read_sweep(entry.path());
    for (const uint64_t seed : parse_seeds(sweep.seeds.value_or("1"))) (sweep.tuned_on ? tuned : judged).insert(seed);
  }
  for (const auto& entry : std::filesystem::directory_iterator(kPapers))
    for (const PaperFlights& flights : read_paper(entry.path()).flights)
      for (const uint64_t seed : parse_seeds(flights.seeds)) judged.insert(seed);
  EXPECT_GT(tuned.size(), 5u);
  for (const uint64_t seed : judged) EXPECT_FALSE(tuned.contains(seed)) << seed;
}

TEST(Calculations, HaveTheirDeclaredColumnsAllOfOneLength) {
  for (const Calculation& calculation : calculations()) {
    const Columns columns = calculation.calculate();
    EXPECT_EQ(columns.size(), calculation.columns.size()) << calculation.name;
    for (const std::string& name : calculation.columns) {
      ASSERT_TRUE(columns.contains(name)) << calculation.name << " " << name;
      EXPECT_EQ(columns.at(name).size(), columns.begin()->second.size()) << calculation.name << " " << name;
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
