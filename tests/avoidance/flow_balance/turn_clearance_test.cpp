#include "avoidance/flow_balance/turn_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

using Eigen::Vector2d;

constexpr Stopping kTurnStopping{.reaction_s = 0.2, .braking_mps2 = 1.7};

Vector2d toward(double bearing_deg, double speed_mps = 1.0) {
  const double bearing_rad = bearing_deg * M_PI / 180.0;
  return speed_mps * Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
}

/// Integrates the velocities that the vehicle reaches one after the other. @return how far it gets along `towards_H`.
double farthest_m(std::vector<Vector2d> velocities_H, const Vector2d& towards_H) {
  constexpr double kStepS = 1e-4;
  Vector2d p_H = Vector2d::Zero(), v_H = velocities_H.front();
  double farthest_m = 0.0;
  for (size_t i = 1; i < velocities_H.size(); ++i) {
    for (double t_s = 0.0; t_s < 4.0; t_s += kStepS) {
      const Vector2d missing_H = velocities_H[i] - v_H;
      if (t_s > kTurnStopping.reaction_s) {
        if (missing_H.norm() < kTurnStopping.braking_mps2 * kStepS) break;
        v_H += missing_H.normalized() * kTurnStopping.braking_mps2 * kStepS;
      }
      p_H += kStepS * v_H;
      farthest_m = std::max(farthest_m, p_H.dot(towards_H));
    }
  }
  return farthest_m;
}

TEST(TurnClearance, IsThatOfAnIntegratedTurnAwayFromAWall) {
  constexpr double kTruncation = 2e-3, kRangeM = 3.0;
  for (const double wall_deg : {0.0, 22.5, -30.0}) {
    for (const double new_deg : {110.0, 135.0, 180.0, 225.0}) {
      const Vector2d towards_H = toward(wall_deg), from_H = toward(45.0, 1.4), to_H = toward(new_deg, 1.4);
      if (to_H.dot(towards_H) > 0.0) continue;
      const double clearance_m = clearance_after_turn_m({from_H, to_H, kTurnStopping}, towards_H, kRangeM);
      EXPECT_NEAR(clearance_m, kRangeM - farthest_m({from_H, to_H}, towards_H), kTruncation) << wall_deg << new_deg;
    }
  }
}

TEST(TurnClearance, CountsASecondTurnInFrontOfTheOtherWallOfACorner) {
  constexpr double kTruncation = 2e-3, kRangeM = 4.0;
  // Walls at 22.5 and 112.5 degrees: away from the first one, the path leads to the second one.
  const Vector2d from_H = toward(45.0, 1.4), to_H = toward(135.0, 1.4), other_H = toward(112.5);
  const double clearance_m = clearance_after_turn_m({from_H, to_H, kTurnStopping}, other_H, kRangeM);
  EXPECT_NEAR(clearance_m, kRangeM - farthest_m({from_H, to_H, -to_H}, other_H), kTruncation);
  EXPECT_GT(clearance_after_turn_m({from_H, -from_H, kTurnStopping}, other_H, kRangeM), clearance_m + 1.0);
}

TEST(TurnClearance, IsTheRangeOfAWallBehind) {
  EXPECT_EQ(clearance_after_turn_m({toward(45.0), toward(60.0), kTurnStopping}, toward(-135.0), 0.4), 0.4);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
