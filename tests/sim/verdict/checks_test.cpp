#include "sim/verdict/assessment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "sim/scenario/reference_path.h"
#include "sim/scenario/validate.h"
#include "tests/sim/record/temporary_folder.h"
#include "tests/sim/verdict/straight_flight.h"

namespace hedgehop::sim {
namespace {

TEST(Checks, CollisionFollowsFromTheOutcome) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(NoCollisionCheck{}).passed);
  f.flight.result.outcome = Outcome::collided;
  EXPECT_FALSE(f.evaluate(NoCollisionCheck{}).passed);
}

TEST(Checks, ClearanceDistinguishesObstaclesFromGround) {
  using To = MinClearanceCheck::To;
  StraightFlight f;
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::obstacles}).value, 1.5);
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::ground}).value, 9.0);
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::anything}).value, 1.5);
  EXPECT_FALSE(f.evaluate(MinClearanceCheck{.at_least_m = 1.6}).passed);
}

/// Without an obstacle in range, the figure is the range, and never "unknown" next to a verdict.
TEST(Checks, ClearanceIsKnownUpToTheSearchRadius) {
  StraightFlight f;
  f.flight.result.closest_obstacle.distance_m = f.flight.result.closest_ground.distance_m =
      std::numeric_limits<double>::infinity();
  for (const CheckResult& result : {f.evaluate(MinClearanceCheck{.at_least_m = 1.0}), f.evaluate(NoCollisionCheck{})}) {
    EXPECT_TRUE(result.passed);
    EXPECT_EQ(result.value, kMaxClearanceM);
    EXPECT_FALSE(result.t_s.has_value());
  }
  f.scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/perez2018_climb.yaml");
  f.scenario.checks = {MinClearanceCheck{.at_least_m = kMaxClearanceM}};
  EXPECT_TRUE(check_errors(f.scenario).empty());
  f.scenario.checks = {MinClearanceCheck{.at_least_m = std::nextafter(kMaxClearanceM, 100.0)}};
  EXPECT_EQ(check_errors(f.scenario).size(), 1u);
}

TEST(Checks, BandsAndBoxesHoldAtEveryTick) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(AltitudeBandCheck{.min_m = 9.0, .max_m = 11.0}).passed);
  EXPECT_TRUE(f.evaluate(InsideBoxCheck{-1.0, 41.0, -1.0, 1.0}).passed);
  f.flight.trajectory[77].p_WB_true.z() = -8.9;
  f.flight.trajectory[78].p_WB_true.y() = 1.25;
  EXPECT_FALSE(f.evaluate(AltitudeBandCheck{.min_m = 9.0, .max_m = 11.0}).passed);
  const CheckResult outside = f.evaluate(InsideBoxCheck{-1.0, 41.0, -1.0, 1.0});
  EXPECT_FALSE(outside.passed);
  EXPECT_NEAR(outside.value, 0.25, 1e-12);
}

TEST(Checks, SpeedAndTiltReportTheirMaximum) {
  StraightFlight f;
  f.flight.trajectory[3].v_WB_W_true = {2.0, 2.0, 1.0};
  EXPECT_DOUBLE_EQ(f.evaluate(MaxSpeedCheck{.at_most_mps = 2.5}).value, 3.0);
  f.flight.trajectory[4].rpy_true = {0.3, 0.4, 1.0};
  // Angle between B's z and W's z is acos(cos(roll) cos(pitch)) by the rotation matrix's last element.
  const double tilt_deg = f.evaluate(MaxTiltCheck{.at_most_rad = 0.2}).value;
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  EXPECT_NEAR(tilt_deg, std::acos(R.col(2).z()) * 180.0 / M_PI, 1e-9);
}

TEST(Checks, RealtimeFactorHoldsFromItsLimitOn) {
  StraightFlight f;
  f.flight.result.realtime_factor = 2.0;
  EXPECT_TRUE(f.evaluate(RealtimeFactorCheck{.at_least = 2.0}).passed);
  EXPECT_FALSE(f.evaluate(RealtimeFactorCheck{.at_least = 2.01}).passed);
}

TEST(Checks, MetricFailsIfOutOfBoundsUnknownOrNotFinite) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(MetricCheck{.name = "reversals", .at_least = 3.0, .at_most = 3.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals", .at_least = 4.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals", .at_most = 2.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "unknown_metric", .at_most = 2.0}).passed);
  f.flight.result.metrics[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals"}).passed);
}

TEST(Checks, MetricReportsTheNearerBound) {
  StraightFlight f;  // with 3 reversals
  const CheckResult low = f.evaluate(MetricCheck{.name = "reversals", .at_least = 2.9, .at_most = 10.0});
  EXPECT_TRUE(low.passed);
  EXPECT_EQ(low.must, ">=");
  EXPECT_EQ(low.limit, 2.9);
  EXPECT_EQ(f.evaluate(MetricCheck{.name = "reversals", .at_least = 0.0, .at_most = 3.1}).limit, 3.1);
}

TEST(Checks, ModuleMetricCannotReplaceAHedgehopMetric) {
  StraightFlight f;
  f.flight.result.metrics = {{"module.corners_found", 1.0, "", FigureKind::module}};
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "corners_found", .at_least = 0.9}).passed);
  EXPECT_TRUE(f.evaluate(MetricCheck{.name = "module.corners_found", .at_least = 0.9}).passed);
}

TEST(Checks, AbsentModuleMetricNamesThoseOfTheModule) {
  StraightFlight f;
  f.flight.result.metrics = {{"module.brake_share", 1.0, "", FigureKind::module}, {"jerk_rms", 1.0, ""}};
  EXPECT_EQ(f.evaluate(MetricCheck{.name = "module.brake_shar", .at_least = 1.0}).cause,
            "the flight has no such metric; this module has: module.brake_share");
  EXPECT_EQ(f.evaluate(MetricCheck{.name = "path_excess", .at_most = 1.0}).cause,
            "the metric does not apply to this flight");
}

TEST(Checks, CollisionIsCheckedOnceUnlessTheScenarioMayCollide) {
  StraightFlight f;
  f.flight.result.outcome = Outcome::collided;
  const auto names = [&f](const std::vector<CheckConfig>& listed) {
    f.scenario.checks = listed;
    std::string all;
    for (const CheckResult& check : evaluate_checks(f.scenario, f.flight, f.scene, 0.8)) {
      all += check.name + (check.passed ? " " : "! ");
    }
    return all;
  };
  EXPECT_EQ(names({}), "no_collision! ");
  EXPECT_EQ(names({NoCollisionCheck{}}), "no_collision! ");
  EXPECT_EQ(names({NoCollisionCheck{}, NoCollisionCheck{}}), "no_collision! ");
  EXPECT_EQ(names({MaxSpeedCheck{.at_most_mps = 3.0}}), "max_speed no_collision! ");
  f.scenario.may_collide = true;
  EXPECT_EQ(names({}), "");
  EXPECT_EQ(names({MaxSpeedCheck{.at_most_mps = 3.0}}), "max_speed ");
}

TEST(Checks, AHullThatPassesThroughAnObstacleFailsNoCollision) {
  StraightFlight f;
  f.scenario.collision_of = CollisionOf::center;
  EXPECT_TRUE(f.evaluate(NoCollisionCheck{}).passed);
  f.flight.result.closest_obstacle.distance_m = -0.2;  // the flight went on to its goal
  const CheckResult result = f.evaluate(NoCollisionCheck{});
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.value, -0.2);
}

TEST(Checks, NoTruthUsedCountsTheEntriesOfTheResult) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(NoTruthUsedCheck{}).passed);
  f.flight.result.truth_used = {"camera 'front': depth", "sensor 'gps': exact"};
  const CheckResult result = f.evaluate(NoTruthUsedCheck{});
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.value, 2.0);
}

/// The straight flight as a reference in a file, and flights that end before or after it.
class PathTolerance : public ::testing::TestWithParam<PathToleranceCheck::Measure> {
 protected:
  PathTolerance() {
    ReferencePath reference{.reason = "straight", .version = "0", .seed = 1, .step_s = 0.1, .points = {}};
    for (const TrajectoryRow& row : flown_.flight.trajectory) reference.points.push_back({row.t_s, row.p_WB_true});
    std::ofstream(file()) << reference_text(reference);
  }
  /// @param rows  of the flight, one every 0.1 s and 0.2 m; beyond 201 it continues.
  CheckResult fly(size_t rows, Outcome outcome, double at_most_m) {
    auto& trajectory = flown_.flight.trajectory;
    while (trajectory.size() < rows) {
      trajectory.push_back(trajectory.back());
      trajectory.back().t_s += 0.1;
      trajectory.back().p_WB_true.x() += 0.2;
    }
    trajectory.resize(rows);
    flown_.flight.result.outcome = outcome;
    return flown_.evaluate(PathToleranceCheck{.reference = file(), .at_most_m = at_most_m, .measure = GetParam()});
  }

 private:
  std::string file() const { return folder_.path() / "straight_reference.csv"; }

  const TemporaryFolder folder_;
  StraightFlight flown_;
};

TEST_P(PathTolerance, HoldsForTheReferenceItself) { EXPECT_TRUE(fly(201, Outcome::timeout, 0.01).passed); }

// The first nine tenths of the path without error: the mean warped distance is well below a meter.
TEST_P(PathTolerance, FailsAFlightThatEndsEarly) {
  for (const Outcome outcome : {Outcome::collided, Outcome::timeout, Outcome::reached}) {
    const CheckResult result = fly(181, outcome, 1.0);
    EXPECT_FALSE(result.passed);
    EXPECT_TRUE(result.unit == "s" ? result.value < result.limit : result.value > result.limit) << result.value;
  }
}

TEST_P(PathTolerance, FlightMayReachTheGoalEarlyWithinItsTolerance) {
  EXPECT_TRUE(fly(198, Outcome::reached, 1.0).passed);
}

TEST_P(PathTolerance, ComparesTheFlightAfterTheReferenceWithItsEnd) {
  EXPECT_TRUE(fly(204, Outcome::timeout, 1.0).passed);
  const CheckResult beyond = fly(221, Outcome::timeout, 1.0);
  EXPECT_FALSE(beyond.passed);
  EXPECT_NEAR(beyond.value, 4.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Measures, PathTolerance,
                         ::testing::Values(PathToleranceCheck::Measure::band, PathToleranceCheck::Measure::frechet,
                                           PathToleranceCheck::Measure::dtw));

TEST(PathToleranceShape, ComparesAPolylineByHandAlongItsSegments) {
  StraightFlight f;
  const TemporaryFolder folder;
  const std::string file = folder.path() / "corners.csv";
  const auto& trajectory = f.flight.trajectory;
  std::ofstream table(file);
  table << "t_s,north_m,east_m,altitude_m\n";
  for (const TrajectoryRow& row : {trajectory.front(), trajectory.back()}) {
    table << row.t_s << ',' << row.p_WB_true.x() << ',' << row.p_WB_true.y() << ',' << -row.p_WB_true.z() << '\n';
  }
  table.close();
  for (const auto measure : {PathToleranceCheck::Measure::frechet, PathToleranceCheck::Measure::dtw}) {
    EXPECT_LT(f.evaluate(PathToleranceCheck{.reference = file, .at_most_m = 0.5, .measure = measure}).value, 0.1);
  }
}

// A flight that stops early is on the path of the reference, but has not flown the rest.
TEST(PathToleranceBand, FailsAFlightThatStopsAtTheHoverOfTheReference) {
  StraightFlight f;
  const TemporaryFolder folder;
  const std::string file = folder.path() / "hover_reference.csv";
  ReferencePath reference{.reason = "hover", .version = "0", .seed = 1, .step_s = 0.1, .points = {}};
  for (TrajectoryRow& row : f.flight.trajectory) {
    row.p_WB_true = {0.0, 0.0, -10.0};
    reference.points.push_back({row.t_s, row.p_WB_true});
  }
  std::ofstream(file) << reference_text(reference);
  for (const size_t rows : {200, 100}) {
    f.flight.trajectory.resize(rows);
    f.flight.result.outcome = Outcome::fault;
    const CheckResult result = f.evaluate(PathToleranceCheck{.reference = file, .at_most_m = 1.0});
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.unit, "s");
    EXPECT_NEAR(result.value, 0.1 * static_cast<double>(rows - 1), 1e-9);
    EXPECT_NEAR(result.limit, 20.0, 1e-9);
  }
}

/// Flies a polyline at 1 m/s in the scenario of a wall to climb, and returns whether all checks hold. The metrics of
/// the module are within their bounds.
bool climb_holds(const std::vector<Eigen::Vector3d>& places_W) {
  Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/perez2018_climb.yaml");
  Flight flight;
  for (size_t i = 0; i + 1 < places_W.size(); ++i) {
    const Eigen::Vector3d way = places_W[i + 1] - places_W[i];
    for (double s = 0.0; s <= way.norm(); s += 0.1) {
      TrajectoryRow row;
      row.t_s = flight.trajectory.empty() ? 0.0 : flight.trajectory.back().t_s + 0.1;
      row.p_WB_true = places_W[i] + s * way.normalized();
      flight.trajectory.push_back(row);
    }
  }
  const Eigen::Vector3d end_W = flight.trajectory.back().p_WB_true;
  flight.result.outcome = scenario.goal->holds(end_W) ? Outcome::reached : Outcome::timeout;
  flight.result.flight_time_s = flight.trajectory.back().t_s;
  flight.result.goal_distance_m = (end_W - scenario.goal->p_WG()).head<2>().norm();
  flight.result.metrics = {{"module.most_rows_above_center", 8.0, ""}, {"module.last_rows_above_center", 0.0, ""}};
  for (const CheckResult& check : evaluate_checks(scenario, flight, {}, 0.5)) {
    if (!check.passed) return false;
  }
  return true;
}

TEST(ClimbOverTheWall, HoldsOnlyForAClimbOverTheWall) {
  EXPECT_TRUE(climb_holds({{0, 0, -4}, {8, 0, -4}, {9, 0, -12}, {37, 0, -12}}));
  EXPECT_FALSE(climb_holds({{0, 0, -4}, {8, 0, -4}, {8, 0, -12}}));  // stays in front of it
  EXPECT_FALSE(climb_holds({{0, 0, -4}, {37, 0, -4}}));              // through it
  EXPECT_FALSE(climb_holds({{0, 0, -4}, {8, 32, -4}, {20, 32, -4}, {30, 0, -12}, {37, 0, -12}}));  // around it
  EXPECT_FALSE(climb_holds({{0, 0, -4}, {0, 0, -40}, {37, 0, -40}, {37, 0, -12}}));                // far above
}

}  // namespace
}  // namespace hedgehop::sim
