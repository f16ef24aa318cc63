#include "sim/reproduce/paper_row.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/config/whole_file.h"
#include "sim/record/table.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Statistic = FlightFigure::Statistic;

FlightRecord flown(const std::string& group, uint64_t seed, const std::string& outcome, double clearance_m) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  record.order = {.id = group + "/seed" + std::to_string(seed), .group = group, .scenario = group + ".yaml"};
  record.order.seed = seed;
  RunResult& result = record.result.emplace();
  result.info.build = "b1";
  result.flight.outcome = parse_outcome(outcome).value();
  result.flight.closest_obstacle.distance_m = clearance_m;
  result.flight.closest_ground.distance_m = std::numeric_limits<double>::infinity();
  result.flight.goal_distance_m = 3.0;
  return record;
}

FlightRecord with_metric(FlightRecord record, double value) {
  record.result->flight.metrics = {{"m", value, ""}};
  return record;
}

FlightRecord not_flown(FlightRecord record, FlightRecord::Status status) {
  record.status = status;
  record.result.reset();
  return record;
}

double brute(Statistic statistic, std::vector<double> values) {
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  const size_t n = values.size();
  if (statistic == Statistic::min) return values[0];
  if (statistic == Statistic::max) return values[n - 1];
  if (statistic == Statistic::mean) return sum / static_cast<double>(n);
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2.0;
}

TEST(MeasuredFigure, EqualsBruteForceOverTheFlightsWithoutAFault) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> clearance(0.0, 5.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<FlightRecord> records;
    std::vector<double> clearances;
    size_t asked = 0, flew = 0, faulted = 0;
    double collided = 0.0;
    const auto count = 1 + random() % 20;
    for (uint64_t seed = 0; seed < count; ++seed) {
      const bool is_a = random() % 2 == 0, hit = random() % 3 == 0;
      FlightRecord record = flown(is_a ? "a" : "b", seed, hit ? "collided" : "reached", clearance(random));
      const auto fate = random() % 6;
      if (fate == 0) record = not_flown(record, FlightRecord::Status::missing);
      if (fate == 1) record.result->flight.outcome = Outcome::fault;
      records.push_back(record);
      if (!is_a) continue;
      ++asked;
      flew += fate == 0 ? 0 : 1;
      faulted += fate == 1 ? 1 : 0;
      if (fate <= 1) continue;
      clearances.push_back(record.result->flight.closest_obstacle.distance_m);
      collided += hit ? 1.0 : 0.0;
    }
    const PaperOutcome outcome = paper_outcome({}, "", records);
    const auto figure = [&](Statistic statistic, const char* column, const char* is) {
      return measure({.flights = {"a"}, .column = column, .is = is, .statistic = statistic}, outcome);
    };
    const MeasuredFigure share = figure(Statistic::share, "outcome", "collided");
    EXPECT_EQ(share.required, asked);
    EXPECT_EQ(share.flown, flew);
    EXPECT_EQ(share.faulted, faulted);
    EXPECT_EQ(share.with_figure, clearances.size());
    EXPECT_TRUE(std::isnan(figure(Statistic::mean, "no_such_column", "").value));
    if (clearances.empty()) {
      EXPECT_TRUE(std::isnan(figure(Statistic::mean, "min_clearance_m", "").value));
      EXPECT_TRUE(std::isnan(share.value));
      continue;
    }
    for (const Statistic statistic : {Statistic::min, Statistic::max, Statistic::mean, Statistic::median}) {
      EXPECT_NEAR(figure(statistic, "min_clearance_m", "").value, brute(statistic, clearances), 1e-12);
    }
    EXPECT_EQ(figure(Statistic::count, "outcome", "collided").value, collided);
    EXPECT_EQ(share.value, collided / static_cast<double>(clearances.size()));
  }
}

class PaperRows : public ::testing::Test {
 protected:
  PaperRows() {
    paper.title = "T";
    paper.source = "S";
    paper.flights = {{.name = "a", .scenario = "a.yaml", .seeds = "1:2"}};
    hits.claim = "hit";
    hits.flights = {"a"};
    hits.column = "outcome";
    hits.is = "collided";
    hits.statistic = Statistic::count;
    hits.at_most = 0.0;
    worst.claim = "worst";
    worst.flights = {"a"};
    worst.column = "metric.m";
    worst.statistic = Statistic::max;
    worst.at_most = 60.0;
  }
  RowOutcome row(const PaperRow& asked, const std::vector<FlightRecord>& records) {
    paper.rows = {asked};
    return row_outcomes(paper_outcome(paper, "", records)).front();
  }
  Paper paper;
  PaperRow hits, worst;
};

TEST_F(PaperRows, HoldOnlyWithinTheRequirement) {
  EXPECT_EQ(row(hits, {flown("a", 1, "reached", 1.0)}).holds, true);
  const RowOutcome failed = row(hits, {flown("a", 1, "reached", 1.0), flown("a", 2, "collided", 0.0)});
  EXPECT_EQ(failed.holds, false);
  EXPECT_EQ(failed.modified_words(), "1 of 2");
  EXPECT_EQ(failed.required_words(), "at most 0");
  EXPECT_EQ(failed.command, "hedgehop batch a.yaml --seeds 1:2");
  EXPECT_THAT(
      rows_text(paper, {failed}),
      HasSubstr("| hit | - | at most 0 | - | - | 1 of 2 | - | 2, 2, 0, 2 | 9 to 91 % | **no** | b1 | `hedgehop"));
}

TEST_F(PaperRows, HaveOneUnitAndPercentIsAHundredTimesAShare) {
  worst.unit = "%";
  worst.at_most = 8.0;
  const RowOutcome share = row(worst, {with_metric(flown("a", 1, "reached", 1.0), 0.0781)});
  EXPECT_EQ(share.holds, true);
  EXPECT_EQ(share.modified_words(), "7.81");
  const RowOutcome above = row(worst, {with_metric(flown("a", 1, "reached", 1.0), 0.080001)});
  EXPECT_EQ(above.holds, false);
  EXPECT_EQ(above.modified_words(), "8.0001");
  hits.statistic = Statistic::share;
  hits.at_most = 0.25;
  EXPECT_EQ(row(hits, {flown("a", 1, "reached", 1.0)}).required_words(), "at most 25 %");
}

TEST_F(PaperRows, CompareThePublishedLawWithTheModifiedLaw) {
  paper.flights[0].published = {"x=1"};
  const RowOutcome result = row(hits, {flown("a", 1, "reached", 1.0), flown("a/published", 1, "collided", 0.0)});
  EXPECT_EQ(result.holds, true);
  EXPECT_EQ(result.published_holds, false);
  paper.flights[0].published.clear();
  EXPECT_EQ(row(hits, {flown("a", 1, "reached", 1.0)}).published_holds, std::nullopt);
}

TEST_F(PaperRows, NineFlightsWithoutTheFigureAndOneWithItDoNotHold) {
  std::vector<FlightRecord> records{with_metric(flown("a", 1, "reached", 1.0), 20.0)};
  for (uint64_t seed = 2; seed <= 10; ++seed) records.push_back(flown("a", seed, "reached", 1.0));
  const RowOutcome result = row(worst, records);
  EXPECT_EQ(result.holds, false);
  EXPECT_EQ(result.modified_words(), "20 (1 of 10 flights)");
  EXPECT_EQ(result.flights_words(), "10, 10, 0, 1");
  EXPECT_FALSE(all_hold({result}));
}

TEST_F(PaperRows, GiveAMissingFigureItsMeaning) {
  const std::vector<FlightRecord> records{with_metric(flown("a", 1, "reached", 1.0), 20.0),
                                          flown("a", 2, "reached", 1.0)};
  worst.missing = "met no collision course";
  EXPECT_EQ(row(worst, records).holds, true);
  EXPECT_EQ(row(worst, records).flights_words(), "2, 2, 0, 1; 1 met no collision course");
  worst.missing = "90";
  EXPECT_EQ(row(worst, records).holds, false);
  EXPECT_EQ(row(worst, records).modified.value, 90.0);
  EXPECT_THAT(row(worst, records).flights_words(), HasSubstr("1 without taken as 90"));
  worst.missing = "30";
  EXPECT_EQ(row(worst, records).holds, true);
}

TEST_F(PaperRows, ExcuseNoFlightThatFaultedOrWasNotFlown) {
  const FlightRecord good = with_metric(flown("a", 1, "reached", 1.0), 20.0);
  worst.missing = "met no collision course";
  EXPECT_EQ(row(worst, {good, with_metric(flown("a", 2, "fault", 1.0), 20.0)}).holds, false);
  for (const auto status : {FlightRecord::Status::failed, FlightRecord::Status::missing}) {
    EXPECT_EQ(row(worst, {good, not_flown(good, status)}).holds, false);
    EXPECT_EQ(row(hits, {good, not_flown(good, status)}).holds, false);
  }
  EXPECT_EQ(row(hits, {good, flown("a", 2, "fault", 1.0)}).flights_words(), "2, 2, 1, 1");
}

TEST_F(PaperRows, DoNotAcceptATimeoutAsAFlightWithoutContact) {
  const FlightRecord reached = flown("a", 1, "reached", 1.0);
  FlightRecord hovers = flown("a", 2, "timeout", 1.0);
  const RowOutcome stuck = row(hits, {reached, hovers});
  EXPECT_EQ(stuck.holds, false);
  EXPECT_EQ(stuck.modified_words(), "0 of 2");
  EXPECT_THAT(stuck.flights_words(), HasSubstr("1 not finished"));
  hovers.result->flight.goal_distance_m.reset();  // without a goal, the full time is the required end
  EXPECT_EQ(row(hits, {reached, hovers}).holds, true);
}

TEST_F(PaperRows, DoNotPassWithoutAMeasurement) {
  const RowOutcome lacking = row(worst, {flown("a", 1, "reached", 1.0)});
  EXPECT_EQ(lacking.modified_words(), "not measured");
  EXPECT_EQ(lacking.holds, false);
  worst.at_most.reset();
  const RowOutcome free = row(worst, {flown("a", 1, "reached", 1.0)});
  EXPECT_EQ(free.holds, std::nullopt);
  EXPECT_FALSE(all_hold({free}));
  const RowOutcome not_asked = row(worst, {});  // not part of a quick run
  EXPECT_TRUE(all_hold({not_asked}));
  EXPECT_EQ(not_asked.modified_words(), "not in the quick run");
}

TEST_F(PaperRows, VariantsDoNotAffectTheVerdict) {
  paper.flights[0].published = {"x=1"};
  paper.flights[0].sensors = {"dull"};
  const RowOutcome result = row(hits, {flown("a", 1, "reached", 1.0), flown("a/published", 1, "collided", 0.0),
                                       flown("a/dull", 1, "fault", 0.0)});
  EXPECT_EQ(result.holds, true);
  EXPECT_EQ(result.variant_words("published"), "1 of 1");
  EXPECT_EQ(result.variant_words("dull"), "not measured");
  EXPECT_EQ(result.variant_words("ideal"), "-");
}

TEST_F(PaperRows, ListBuildsAndUsedTruth) {
  FlightRecord other = flown("a", 2, "reached", 1.0);
  other.result->info.build = "b2";
  other.result->flight.truth_used = {"camera 'front': projected corners"};
  const RowOutcome result = row(hits, {flown("a", 1, "reached", 1.0), other});
  EXPECT_THAT(result.builds, ElementsAre("b1", "b2"));
  EXPECT_THAT(result.flights_words(), HasSubstr("truth used: camera 'front': projected corners"));
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "rows.csv", rows_csv({{paper, {result}}}));
  const Table table(folder.path() / "rows.csv");
  EXPECT_EQ(table.words("build")[0], "b1; b2");
  EXPECT_EQ(table.words("truth_used")[0], "camera 'front': projected corners");
  EXPECT_EQ(table.numbers("with_figure")[0], 2);
}

}  // namespace
}  // namespace hedgehop::sim
