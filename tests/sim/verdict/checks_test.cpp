#include "sim/verdict/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hedgehop::sim {
namespace {

/// A straight flight north at 2 m/s and 10 m altitude, 0 to 20 s, that ends 1 m from its goal.
struct StraightFlight {
  Scenario scenario;
  Flight flight;
  scenes::Scene scene;

  StraightFlight() {
    scenario.duration_s = 100.0;
    scenario.goal = GoalConfig{.north_m = 41.0, .radius_m = 2.0};
    for (int i = 0; i <= 200; ++i) {
      TrajectoryRow row;
      row.t_s = 0.1 * i;
      row.p_WB_true = {0.2 * i, 0.0, -10.0};
      row.rpy_true = {0.0, -0.1, 0.0};
      row.v_WB_W_true = {2.0, 0.0, 0.0};
      row.w_WB_B_true.setZero();
      flight.trajectory.push_back(row);
    }
    flight.result.outcome = Outcome::reached;
    flight.result.flight_time_s = 20.0;
    flight.result.goal_distance_m = 1.0;
    flight.result.closest_obstacle.distance_m = 1.5;
    flight.result.closest_ground.distance_m = 9.0;
    flight.result.metrics = {{"reversals", 3.0, ""}};
    scene.bounds_NE_m = {Eigen::Vector2d(0.0, -5.0), Eigen::Vector2d(40.0, 5.0)};
  }

  CheckResult evaluate(const CheckConfig& check) {
    scenario.checks = {check};
    return evaluate_checks(scenario, flight, scene, 0.8).front();
  }
};

TEST(Checks, ReachedGoalNeedsDistanceTimeAndOutcome) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(ReachedGoalCheck{}).passed);
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{.within_m = 0.5}).passed);
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{.before_s = 19.0}).passed);
  f.flight.result.outcome = Outcome::collided;
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{}).passed);
}

TEST(Checks, ReachedGoalFailsWhereThereIsNoGoal) {
  StraightFlight f;
  f.scenario.goal.reset();
  const CheckResult result = f.evaluate(ReachedGoalCheck{});
  EXPECT_FALSE(result.passed);
  EXPECT_TRUE(std::isnan(result.value));
}

TEST(Checks, CollisionIsWhatTheOutcomeSays) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(NoCollisionCheck{}).passed);
  f.flight.result.outcome = Outcome::collided;
  EXPECT_FALSE(f.evaluate(NoCollisionCheck{}).passed);
}

TEST(Checks, ClearanceTellsObstaclesFromGround) {
  using To = MinClearanceCheck::To;
  StraightFlight f;
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::obstacles}).value, 1.5);
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::ground}).value, 9.0);
  EXPECT_DOUBLE_EQ(f.evaluate(MinClearanceCheck{.at_least_m = 1.0, .to = To::anything}).value, 1.5);
  EXPECT_FALSE(f.evaluate(MinClearanceCheck{.at_least_m = 1.6}).passed);
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

TEST(Checks, SpeedAndTiltKeepTheirLargestValue) {
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

TEST(Checks, MetricOutsideBoundsUnknownOrNotFiniteFails) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(MetricCheck{.name = "reversals", .at_least = 3.0, .at_most = 3.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals", .at_least = 4.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals", .at_most = 2.0}).passed);
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "nothing", .at_most = 2.0}).passed);
  f.flight.result.metrics[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(f.evaluate(MetricCheck{.name = "reversals"}).passed);
}

TEST(VisitedShare, EqualsTheDefinitionOnRandomPaths) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    std::uniform_real_distribution<double> uniform(-6.0, 6.0), size(0.3, 2.0);
    const Eigen::AlignedBox2d plan(Eigen::Vector2d(-4.0, -5.0), Eigen::Vector2d(4.0, 5.0));
    const double radius_m = size(random);
    std::vector<Eigen::Vector2d> path;
    for (int i = 0; i < 8; ++i) path.emplace_back(uniform(random), uniform(random));
    int visited = 0;
    for (int row = 0; row < 8; ++row) {
      for (int col = 0; col < 10; ++col) {
        bool covered = false;
        for (const Eigen::Vector2d& p : path) {
          covered = covered || std::hypot(-3.5 + row - p.x(), -4.5 + col - p.y()) <= radius_m;
        }
        visited += covered;
      }
    }
    EXPECT_DOUBLE_EQ(visited_share(plan, 1.0, path, radius_m), visited / 80.0);
  }
}

}  // namespace
}  // namespace hedgehop::sim
