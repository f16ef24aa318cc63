#include "avoidance/flow_balance/stopping.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace hedgehop::avoidance::flow_balance {
namespace {

TEST(InverseRangeLeft, IsThatOfTheRangeLessTheDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(0.5, 20.0), stopping(0.0, 3.0);
  for (int i = 0; i < 1000; ++i) {
    const double range_m = range(random), distance_m = stopping(random), left_m = range_m - distance_m;
    const double left_per_m = inverse_range_left_per_m(1.0 / range_m, distance_m);
    if (left_m > 1e-3) {
      EXPECT_NEAR(left_per_m * left_m, 1.0, 1e-9);
    } else {
      EXPECT_EQ(left_per_m, 1000.0);
    }
  }
}

TEST(InverseRangeLeft, OfWhatIsFarStaysZero) { EXPECT_EQ(inverse_range_left_per_m(0.0, 3.0), 0.0); }

// A point whose velocity is reversed as a whole by a steady acceleration, in small steps.
TEST(StoppingDistance, IsWhatAPointThatReversesStillCovers) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> speed(0.2, 3.0), angle(-1.5, 1.5), braking(0.3, 4.0), reaction(0.0, 1.0);
  for (int i = 0; i < 50; ++i) {
    const double speed_mps = speed(random), angle_rad = angle(random);
    const Stopping stopping{reaction(random), braking(random)};
    const Eigen::Vector2d v0 = speed_mps * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    constexpr double kStepS = 1e-4;
    Eigen::Vector2d v = v0;
    double covered_m = 0.0;
    for (double t_s = 0.0; v.x() > 0.0; t_s += kStepS) {
      if (t_s >= stopping.reaction_s) v -= kStepS * stopping.braking_mps2 * v0.normalized();
      covered_m += kStepS * v.x();
    }
    EXPECT_NEAR(stopping_distance_m(v0.x(), speed_mps, stopping), covered_m, 2e-3);
    EXPECT_EQ(stopping_distance_m(-v0.x(), speed_mps, stopping), 0.0);
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
