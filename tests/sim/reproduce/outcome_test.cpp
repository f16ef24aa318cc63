#include "sim/reproduce/outcome.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using Statistic = FlightFigure::Statistic;

FlightRecord flown(const std::string& group, uint64_t seed, bool collided, double clearance_m) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  record.order = {.id = group + "/seed" + std::to_string(seed), .group = group, .scenario = group + ".yaml"};
  record.order.seed = seed;
  record.result = {{"outcome", collided ? "collided" : "reached"},
                   {"min_clearance_m", clearance_m},
                   {"metrics", nlohmann::ordered_json::object()},
                   {"checks", nlohmann::ordered_json::array()}};
  return record;
}

double brute(Statistic statistic, std::vector<double> values) {
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  const size_t n = values.size();
  if (statistic == Statistic::least) return values[0];
  if (statistic == Statistic::greatest) return values[n - 1];
  if (statistic == Statistic::mean) return sum / static_cast<double>(n);
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2.0;
}

TEST(PaperOutcome, FiguresAreThoseOfBruteForceOverTheFlightsThatEnded) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> clearance(0.0, 5.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<FlightRecord> records;
    std::vector<double> clearances;
    double collided = 0.0;
    const auto count = 1 + random() % 20;
    for (uint64_t seed = 0; seed < count; ++seed) {
      const std::string group = random() % 2 == 0 ? "a" : "b";
      const bool hit = random() % 3 == 0;
      records.push_back(flown(group, seed, hit, clearance(random)));
      if (random() % 5 == 0) {
        records.back().status = FlightRecord::Status::missing;
        records.back().result = nullptr;
      } else if (group == "a") {
        clearances.push_back(records.back().result["min_clearance_m"].get<double>());
        collided += hit ? 1.0 : 0.0;
      }
    }
    const PaperOutcome outcome = paper_outcome({}, "", records);
    const auto figure = [&](Statistic statistic, const char* column, const char* is) {
      return figure_of({.flights = {"a"}, .column = column, .is = is, .statistic = statistic}, outcome);
    };
    if (clearances.empty()) {
      EXPECT_TRUE(std::isnan(figure(Statistic::mean, "min_clearance_m", "")));
      EXPECT_TRUE(std::isnan(figure(Statistic::count, "outcome", "collided")));
      continue;
    }
    for (const Statistic statistic : {Statistic::least, Statistic::greatest, Statistic::mean, Statistic::median}) {
      EXPECT_NEAR(figure(statistic, "min_clearance_m", ""), brute(statistic, clearances), 1e-12);
    }
    EXPECT_EQ(figure(Statistic::count, "outcome", "collided"), collided);
    EXPECT_EQ(figure(Statistic::share, "outcome", "collided"), collided / static_cast<double>(clearances.size()));
    EXPECT_TRUE(std::isnan(figure(Statistic::mean, "no_such_column", "")));
  }
}

TEST(PaperOutcome, ARowHoldsOnlyWithinWhatIsAskedAndIsSilentWhenNothingFlew) {
  Paper paper{.title = "T", .source = "S", .flights = {{.name = "a", .scenario = "a.yaml", .seeds = "1:2"}}};
  PaperRow hits;
  hits.what = "hit";
  hits.flights = {"a"};
  hits.column = "outcome";
  hits.is = "collided";
  hits.statistic = Statistic::count;
  hits.at_most = 0.0;
  paper.rows = {hits};
  const auto row = [&](const std::vector<FlightRecord>& records) {
    return row_outcomes(paper_outcome(paper, "", records)).front();
  };
  EXPECT_EQ(row({flown("a", 1, false, 1.0)}).holds, true);
  const RowOutcome failed = row({flown("a", 1, false, 1.0), flown("a", 2, true, 0.0)});
  EXPECT_EQ(failed.holds, false);
  EXPECT_EQ(failed.ours, "1 of 2");
  EXPECT_EQ(failed.asked, "at most 0");
  EXPECT_EQ(failed.command, "hedgehop batch a.yaml --seeds 1:2");
  EXPECT_THAT(rows_text(paper, {failed}), HasSubstr("| hit |  | at most 0 | 1 of 2 | **no** |"));
  FlightRecord killed = flown("a", 3, false, 1.0);
  killed.status = FlightRecord::Status::failed;
  killed.result = nullptr;
  const RowOutcome broken = row({killed, killed});
  EXPECT_EQ(broken.holds, false);
  EXPECT_EQ(broken.ours, "not measured, 2 flights broken");
  const RowOutcome unflown = row({});
  EXPECT_EQ(unflown.holds, std::nullopt);
  EXPECT_EQ(unflown.ours, "not measured");
}

}  // namespace
}  // namespace hedgehop::sim
