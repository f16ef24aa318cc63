#include "sim/falsify/competition_score.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hedgehop::sim {
namespace {

using scenes::BoxConfig;
using ::testing::Optional;

constexpr double kRounding = 1e-9;

BoxConfig box(double north_m, double east_m, double length_m, double width_m, double heading_deg = 0.0) {
  return {.north_m = north_m,
          .east_m = east_m,
          .length_m = length_m,
          .width_m = width_m,
          .heading_rad = heading_deg * std::numbers::pi / 180.0};
}

TEST(CompetitionScore, PointsOfARunHaveTheStepsOfTheReport) {
  EXPECT_EQ(run_points(-0.1), 5);
  EXPECT_EQ(run_points(0.2499), 5);
  EXPECT_EQ(run_points(0.25), 2);
  EXPECT_EQ(run_points(0.9999), 2);
  EXPECT_EQ(run_points(1.0), 1);
  EXPECT_EQ(run_points(1.4999), 1);
  EXPECT_EQ(run_points(1.5), 0);
  EXPECT_EQ(run_points(std::numeric_limits<double>::infinity()), 0);
}

/// Points 5, 2, 1, 0, 2: mean 2. Times 30, 60, 90, 60, 60 s: mean 1 min.
TEST(CompetitionScore, ScoreOfATestFallsWithBoxesAndTime) {
  std::vector<CompetitionRun> runs = {{0.1, 30.0}, {0.5, 60.0}, {1.2, 90.0}, {1.6, 60.0}, {0.9, 60.0}};
  EXPECT_NEAR(test_score(runs, 1), 20.0, kRounding);
  EXPECT_NEAR(test_score(runs, 2), 5.0, kRounding);
  EXPECT_NEAR(test_score(runs, 3), 20.0 / 9.0, kRounding);
  for (CompetitionRun& run : runs) run.time_s *= 4.0;
  EXPECT_NEAR(test_score(runs, 2), 1.25, kRounding);
}

TEST(CompetitionScore, SimilarityIsTheCommonPartOfBothAreas) {
  const std::vector<BoxConfig> one = {box(0.0, 20.0, 4.0, 2.0)};
  EXPECT_NEAR(similarity(one, one), 1.0, kRounding);
  EXPECT_NEAR(similarity(one, {box(2.0, 20.0, 4.0, 2.0)}), 4.0 / 12.0, kRounding);
  EXPECT_EQ(similarity(one, {box(0.0, 26.0, 4.0, 2.0)}), 0.0);
  EXPECT_NEAR(similarity({box(0.0, 20.0, 10.0, 2.0)}, {box(0.0, 20.0, 10.0, 2.0, 90.0)}), 4.0 / 36.0, kRounding);
  // Two unit squares, one turned by 45 degrees, share a regular octagon.
  const double octagon = 2.0 * (std::numbers::sqrt2 - 1.0);
  EXPECT_NEAR(similarity({box(5.0, 5.0, 1.0, 1.0)}, {box(5.0, 5.0, 1.0, 1.0, 45.0)}), octagon / (2.0 - octagon),
              kRounding);
  // The second box of each test is apart from the first ones: 4 of 12 + 8 m2 are common.
  EXPECT_NEAR(similarity({one[0], box(20.0, 20.0, 2.0, 2.0)}, {box(2.0, 20.0, 4.0, 2.0), box(-20.0, 20.0, 2.0, 2.0)}),
              4.0 / 20.0, kRounding);
}

TEST(CompetitionScore, DiversityIsTheMeanDissimilarityOfPairs) {
  const std::vector<BoxConfig> one = {box(0.0, 20.0, 4.0, 2.0)}, shifted = {box(2.0, 20.0, 4.0, 2.0)},
                               apart = {box(0.0, 30.0, 4.0, 2.0)};
  EXPECT_THAT(diversity_score({one, shifted, apart}), Optional(::testing::DoubleNear(1.0 - 1.0 / 9.0, kRounding)));
  EXPECT_THAT(diversity_score({one, one}), Optional(::testing::DoubleNear(0.0, kRounding)));
  EXPECT_EQ(diversity_score({one}), std::nullopt);
}

FlightRecord flown(double distance_m, double time_s) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  FlightResult& result = record.result.emplace().flight;
  result.outcome = Outcome::reached;
  result.closest_obstacle.distance_m = distance_m;
  result.flight_time_s = time_s;
  return record;
}

/// With one box and flights of one minute, points 5, 2 and 1 are scores of 50, 20 and 10.
TEST(CompetitionScore, ObjectiveOfASearchOrdersFlightsByScoreThenByDistance) {
  FalsifySearch search;
  search.config.score = FalsifyScore::sbft;
  search.config.boxes = FalsifyBoxes{.count = 1};
  const auto at = [&](double distance_m) { return objective(search, flown(distance_m, 60.0))->robustness; };
  EXPECT_EQ(at(std::numeric_limits<double>::infinity()), kMaxClearanceM - kSafeDistanceM);
  EXPECT_NEAR(at(1.7), 0.2, kRounding);
  EXPECT_EQ(at(1.5), 0.0);
  EXPECT_NEAR(at(1.2), -10.03, kRounding);
  EXPECT_LT(at(1.1), at(1.2));
  EXPECT_NEAR(at(0.5), -20.1, kRounding);
  EXPECT_NEAR(at(0.0), -50.15, kRounding);
  EXPECT_EQ(objective(search, FlightRecord{.status = FlightRecord::Status::failed}), std::nullopt);
}

}  // namespace
}  // namespace hedgehop::sim
