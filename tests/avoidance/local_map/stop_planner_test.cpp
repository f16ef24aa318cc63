#include "avoidance/local_map/stop_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/libm/random.h"

namespace hedgehop::avoidance::local_map {
namespace {

constexpr Response kResponse{.delay_s = 0.2, .lag_s = 0.4, .acceleration_mps2 = 3.0, .braking_mps2 = 2.0};
constexpr double kSpeedMps = 8.0;

/// Free space up to a line in the north; the goal is beyond it.
StopPlanner::DeficitAt wall_at(double north_m) {
  return [=](const PathState& m) { return ClearanceDeficit{.occupied_m = std::max(0.0, m.p_W.x() - north_m)}; };
}
std::optional<double> north(const Eigen::Vector2d& p_W) { return 100.0 - p_W.x(); }

double nobody(const std::vector<PathState>&) { return 0.0; }

TEST(StopPlanner, EveryPlannedStopEndsWithinFreeSpace) {
  const StopPlanner planner(kResponse, kSpeedMps);
  for (const double free_m : {2.0, 5.0, 10.0, 20.0, 40.0}) {
    PathState now{0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    Eigen::Vector2d cmd_W = Eigen::Vector2d::Zero();
    double fastest = 0.0;
    for (int i = 0; i < 300; ++i) {
      const StopPlanner::Plan plan = planner.choose(now, cmd_W, wall_at(free_m), nobody, north);
      ASSERT_TRUE(plan.safe) << free_m << " " << i;
      ASSERT_LE(plan.path.back().p_W.x(), free_m);
      // The command in effect until the next image, 0.1 s, is the planned one.
      now = planner.predict(now, cmd_W, plan.v_cmd_W, 0.1)[1];
      cmd_W = plan.v_cmd_W;
      fastest = std::max(fastest, now.v_W.norm());
      ASSERT_LE(now.p_W.x(), free_m);
    }
    EXPECT_GT(now.p_W.x(), free_m - 0.5);
    EXPECT_LE(fastest, kSpeedMps + 1e-9);
  }
}

TEST(StopPlanner, SpeedFollowsTheLengthOfFreeSpace) {
  const StopPlanner planner(kResponse, kSpeedMps);
  for (const double speed_mps : {1.0, 3.0, 6.0}) {
    // Closed form: the delay and a lag at speed, then constant braking.
    const double stop_m =
        speed_mps * (kResponse.delay_s + kResponse.lag_s) + 0.5 * speed_mps * speed_mps / kResponse.braking_mps2;
    const PathState now{0.0, Eigen::Vector2d::Zero(), {speed_mps, 0.0}};
    constexpr double kSlackM = 1.0;
    // A command against the motion stops sooner than planned braking, but needs more than a third of the distance.
    EXPECT_TRUE(planner.choose(now, now.v_W, wall_at(stop_m + kSlackM), nobody, north).safe);
    EXPECT_FALSE(planner.choose(now, now.v_W, wall_at(0.35 * stop_m), nobody, north).safe);
  }
}

TEST(StopPlanner, VehicleWithinTheClearanceMovesAway) {
  const StopPlanner planner(kResponse, kSpeedMps);
  const PathState now{0.0, {1.0, 0.0}, Eigen::Vector2d::Zero()};
  const StopPlanner::Plan plan = planner.choose(now, Eigen::Vector2d::Zero(), wall_at(0.5), nobody, north);
  EXPECT_TRUE(plan.safe);
  EXPECT_LT(plan.v_cmd_W.x(), 0.0);
}

TEST(StopPlanner, FliesSlowlyInDirectionsOutOfView) {
  const PathState now{0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  const auto south = [](const Eigen::Vector2d& p_W) { return std::optional(100.0 + p_W.x()); };
  const auto free = [](const PathState&) { return ClearanceDeficit{}; };
  const auto speed_mps = [&](const StopPlanner& planner) {
    return planner.choose(now, Eigen::Vector2d::Zero(), free, nobody, south).v_cmd_W.norm();
  };
  const auto ahead = [](double azimuth_rad) { return std::abs(azimuth_rad) < 0.7; };
  EXPECT_LE(speed_mps(StopPlanner(kResponse, kSpeedMps, ahead)), 2.0);
  EXPECT_GT(speed_mps(StopPlanner(kResponse, kSpeedMps)), 2.5);
}

/// Half-planes of an obstacle and of unknown space, whose edges are `near_m` and `far_m` from the origin in two
/// directions.
TEST(StopPlanner, ViolationOfOneClearanceNeverExcusesTheOther) {
  const StopPlanner planner(kResponse, kSpeedMps);
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) { return hedgehop::uniform(random, low, high); };
  for (int i = 0; i < 300; ++i) {
    const bool occupied_first = i % 2 == 0;
    const double near_m = uniform(-1.0, -0.1), far_m = uniform(0.0, 1.5);  // violated by up to 1 m; not violated
    const double azimuth = uniform(0.0, 2.0 * M_PI), other = azimuth + uniform(1.0, 2.0 * M_PI - 1.0);
    const auto beyond_m = [](const Eigen::Vector2d& p_W, double turn, double edge_m) {
      return std::max(0.0, p_W.dot(Eigen::Vector2d(std::cos(turn), std::sin(turn))) - edge_m);
    };
    const auto deficit = [&](const PathState& m) {
      const double first_m = beyond_m(m.p_W, azimuth, near_m), second_m = beyond_m(m.p_W, other, far_m);
      return occupied_first ? ClearanceDeficit{first_m, second_m} : ClearanceDeficit{second_m, first_m};
    };
    const double toward = uniform(0.0, 2.0 * M_PI);
    const auto to_goal_m = [&](const Eigen::Vector2d& p_W) -> std::optional<double> {
      return 100.0 - p_W.dot(Eigen::Vector2d(std::cos(toward), std::sin(toward)));
    };
    const PathState now{0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    const StopPlanner::Plan plan = planner.choose(now, Eigen::Vector2d::Zero(), deficit, nobody, to_goal_m);
    ASSERT_TRUE(plan.safe) << i;
    for (const PathState& m : plan.path) ASSERT_EQ(beyond_m(m.p_W, other, far_m), 0.0) << i;
  }
}

// At 6 m/s, 4 m in front of a wall that ends 1 m to the right: braking ends in the wall, a turn leads around it.
TEST(StopPlanner, TakesThePathOfMinimumViolationIfNoStopIsPossible) {
  const StopPlanner planner(kResponse, kSpeedMps);
  const auto deficit = [](const PathState& m) {
    const double into_m = std::min(m.p_W.x() - 4.0, 1.0 - m.p_W.y());
    return ClearanceDeficit{.occupied_m = m.p_W.x() < 5.0 ? std::max(0.0, into_m) : 0.0};
  };
  const auto worst_m = [&](const std::vector<PathState>& path) {
    double worst = 0.0;
    for (const PathState& m : path) worst = std::max(worst, deficit(m).occupied_m);
    return worst;
  };
  const PathState now{0.0, Eigen::Vector2d::Zero(), {6.0, 0.0}};
  const StopPlanner::Plan plan = planner.choose(now, now.v_W, deficit, nobody, north);
  EXPECT_FALSE(plan.safe);
  EXPECT_LT(worst_m(plan.path), 0.8 * worst_m(planner.predict(now, now.v_W, Eigen::Vector2d::Zero(), 0.0)));
}

// At 4 m/s in front of a wall that can no longer be avoided and is thin to the side of the course. Braking ends 0.4 m
// inside the wall at low speed. A turn crosses 0.6 m of it at full speed, less than 0.3 m from its faces.
TEST(StopPlanner, PrefersASlowDeepViolationIfNoStopIsPossible) {
  const StopPlanner planner(kResponse, kSpeedMps);
  constexpr double kWallM = 3.1;
  const auto deficit = [](const PathState& m) {
    const double behind_m = std::abs(m.p_W.y()) < 0.3 ? 100.0 : kWallM + 0.6;
    return ClearanceDeficit{.occupied_m = std::max(0.0, std::min(m.p_W.x() - kWallM, behind_m - m.p_W.x()))};
  };
  const auto at_mps = [&](const StopPlanner::Plan& plan) {
    for (const PathState& m : plan.path) {
      if (deficit(m).occupied_m > 0.0) return m.v_W.norm();
    }
    return 0.0;
  };
  const PathState now{0.0, Eigen::Vector2d::Zero(), {4.0, 0.0}};
  const StopPlanner::Plan plan = planner.choose(now, now.v_W, deficit, nobody, north);
  EXPECT_FALSE(plan.safe);
  EXPECT_LT(at_mps(plan), 2.5);
}

// Braking for a crossing obstacle stops in its path; continuing passes in time.
TEST(StopPlanner, PassesInFrontOfAMovingObstacleInsteadOfStoppingInItsPath) {
  const StopPlanner planner(kResponse, kSpeedMps);
  const PathState now{0.0, Eigen::Vector2d::Zero(), {6.0, 0.0}};
  const auto crosses = [](const std::vector<PathState>& path) {  // a band at 8 to 11 m, from 2.5 s on
    double worst_m = 0.0;
    for (const PathState& m : path) {
      if (m.t_s > 2.5) worst_m = std::max(worst_m, 1.5 - std::abs(m.p_W.x() - 9.5));
    }
    return std::max(worst_m, 1.5 - std::abs(path.back().p_W.x() - 9.5));
  };
  const auto anywhere = [](const PathState&) { return ClearanceDeficit{}; };
  const auto aside = [](const Eigen::Vector2d& p_W) -> std::optional<double> { return std::abs(p_W.y()) * 100.0; };
  const StopPlanner::Plan plan = planner.choose(now, now.v_W, anywhere, crosses, aside);
  EXPECT_GT(crosses(planner.predict(now, now.v_W, Eigen::Vector2d::Zero(), 0.4)), 0.0);
  double least_m = 1e9;
  for (const double hold_s : {0.4, 1.2, 2.4}) {
    least_m = std::min(least_m, crosses(planner.predict(now, now.v_W, plan.v_cmd_W, hold_s)));
  }
  EXPECT_EQ(least_m, 0.0);
}

TEST(StopPlanner, PredictionsBrakeAtTheGivenRate) {
  const StopPlanner planner(kResponse, kSpeedMps);
  const PathState now{0.0, Eigen::Vector2d::Zero(), {6.0, 0.0}};
  const std::vector<PathState> path = planner.predict(now, now.v_W, Eigen::Vector2d::Zero(), 0.0);
  const double lag_mps = kResponse.braking_mps2 * kResponse.lag_s;  // below, braking fades
  const double ramp_m = (36.0 - lag_mps * lag_mps) / (2.0 * kResponse.braking_mps2), tail_m = lag_mps * kResponse.lag_s;
  constexpr double kStepsM = 0.7;  // a tenth of a second at speed
  EXPECT_NEAR(path.back().p_W.x(), 6.0 * kResponse.delay_s + ramp_m + tail_m, kStepsM);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
