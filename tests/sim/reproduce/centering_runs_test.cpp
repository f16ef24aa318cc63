#include "sim/reproduce/calculations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::sim {
namespace {

TEST(CenteringRuns, ExactSignalDecaysWithTheSlowerPoleOfTheContinuousLoop) {
  const std::vector<double> off_m = centering_exact().at("off_middle_m");
  // Roll u gives g u aside and turning at u another v u: y'' = -(g + v)(kp T y' + kD y) / 2 m for small angles.
  const double gain = (9.80665 + 0.42) / 2.0, damping = gain * 0.2 * 0.5, stiffness = gain * 0.009;
  const double slower_per_s = 0.5 * (damping - std::sqrt(damping * damping - 4.0 * stiffness));
  constexpr size_t kFrom = 80, kTo = 100;      // 40 s and 50 s, when the faster pole's share is gone
  constexpr double kHeldForHalfASecond = 0.1;  // effect of sampling on a rate of 0.12 /s, as a share of the ratio
  const double ratio = off_m.at(kTo) / off_m.at(kFrom), expected = std::exp(-10.0 * slower_per_s);
  EXPECT_NEAR(ratio, expected, kHeldForHalfASecond * expected);
  EXPECT_LT(*std::ranges::max_element(off_m), 0.05);  // two real poles: no overshoot
}

TEST(CenteringRuns, NoisySignalKeepsOffTheWalls) {
  const Columns noisy = centering_noisy(), exact = centering_exact();
  const std::vector<double>& off_m = noisy.at("off_middle_m");
  EXPECT_GT(*std::ranges::max_element(off_m), 0.1);
  EXPECT_LT(*std::ranges::max_element(off_m), 2.0);
  EXPECT_GT(*std::ranges::min_element(off_m), -2.0);
  EXPECT_GT(noisy.at("settled_m").back(), exact.at("settled_m").back());
}

}  // namespace
}  // namespace hedgehop::sim
