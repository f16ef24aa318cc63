#include "avoidance/flow_balance/range_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Measurement = RangeMemory::Measurement;

double update(RangeMemory& memory, const Measurement& measurement, double dt_s) {
  return memory.update(std::vector<Measurement>{measurement}, dt_s).front();
}

TEST(RangeMemory, TakesAWellMeasuredRangeAsItIs) {
  RangeMemory memory(1.0);
  EXPECT_EQ(update(memory, {0.5, 1.0, 2.0}, 0.02), 0.5);
  EXPECT_EQ(update(memory, {0.1, 1.0, 2.0}, 0.02), 0.1);
}

TEST(RangeMemory, CarriesAWallOnAtTheSpeedItIsClosedInOn) {
  // From 4 m at 1.5 m/s for 1.2 s, blind: 2.2 m are left.
  RangeMemory memory(1e6);
  constexpr double kStepS = 1e-4;
  double inverse_per_m = update(memory, {0.25, 1.0, 1.5}, kStepS);
  for (int i = 0; i < 12000; ++i) inverse_per_m = update(memory, {0.0, 0.0, 1.5}, kStepS);
  EXPECT_NEAR(1.0 / inverse_per_m, 2.2, 2e-3);
}

TEST(RangeMemory, FadesInItsTimeConstant) {
  RangeMemory memory(0.8);
  update(memory, {0.5, 1.0, 0.0}, 0.1);
  double inverse_per_m = 0.0;
  for (int i = 0; i < 8; ++i) inverse_per_m = update(memory, {kNan, 0.0, 0.0}, 0.1);
  EXPECT_NEAR(inverse_per_m, 0.5 * std::exp(-1.0), 1e-12);
}

TEST(RangeMemory, FillsInWhatTheWeightLeavesOut) {
  // A true inverse range of 0.4 measured with weight 0.3 reads 0.12; what is known completes it.
  RangeMemory memory(1e9);
  update(memory, {0.4, 1.0, 0.0}, 0.02);
  EXPECT_NEAR(update(memory, {0.3 * 0.4, 0.3, 0.0}, 0.02), 0.4, 1e-9);
}

TEST(RangeMemory, OfNoneForgetsAtOnce) {
  RangeMemory memory(0.0);
  update(memory, {0.5, 1.0, 0.0}, 0.02);
  EXPECT_EQ(update(memory, {0.01, 0.1, 0.0}, 0.02), 0.01);
  EXPECT_TRUE(std::isnan(update(memory, {kNan, 0.0, 0.0}, 0.02)));
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
