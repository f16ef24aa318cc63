#include "avoidance/flow_balance/range_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Sight = RangeMemory::Sight;

double told(RangeMemory& memory, const Sight& sight, double dt_s) {
  return memory.update(std::vector<Sight>{sight}, dt_s).front();
}

TEST(RangeMemory, TakesAWellToldRangeAsItIs) {
  RangeMemory memory(1.0);
  EXPECT_EQ(told(memory, {0.5, 1.0, 2.0}, 0.02), 0.5);
  EXPECT_EQ(told(memory, {0.1, 1.0, 2.0}, 0.02), 0.1);
}

TEST(RangeMemory, CarriesAWallOnAtTheSpeedItIsClosedInOn) {
  // From 4 m at 1.5 m/s for 1.2 s, blind: 2.2 m are left.
  RangeMemory memory(1e6);
  constexpr double kStepS = 1e-4;
  double near_per_m = told(memory, {0.25, 1.0, 1.5}, kStepS);
  for (int i = 0; i < 12000; ++i) near_per_m = told(memory, {0.0, 0.0, 1.5}, kStepS);
  EXPECT_NEAR(1.0 / near_per_m, 2.2, 2e-3);
}

TEST(RangeMemory, FadesInItsTimeConstant) {
  RangeMemory memory(0.8);
  told(memory, {0.5, 1.0, 0.0}, 0.1);
  double near_per_m = 0.0;
  for (int i = 0; i < 8; ++i) near_per_m = told(memory, {kNan, 0.0, 0.0}, 0.1);
  EXPECT_NEAR(near_per_m, 0.5 * std::exp(-1.0), 1e-12);
}

TEST(RangeMemory, FillsInWhatTheWeightLeavesOut) {
  // A true inverse range of 0.4 told with weight 0.3 reads 0.12; what is known completes it.
  RangeMemory memory(1e9);
  told(memory, {0.4, 1.0, 0.0}, 0.02);
  EXPECT_NEAR(told(memory, {0.3 * 0.4, 0.3, 0.0}, 0.02), 0.4, 1e-9);
}

TEST(RangeMemory, OfNoneForgetsAtOnce) {
  RangeMemory memory(0.0);
  told(memory, {0.5, 1.0, 0.0}, 0.02);
  EXPECT_EQ(told(memory, {0.01, 0.1, 0.0}, 0.02), 0.01);
  EXPECT_TRUE(std::isnan(told(memory, {kNan, 0.0, 0.0}, 0.02)));
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
