#include "avoidance/flow_balance/lasting_ranges.h"

#include <gtest/gtest.h>

#include <limits>

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(LastingRanges, OneWrongImageBringsNothingNear) {
  LastingRanges ranges(3);
  for (const double near : {0.1, 0.9, 0.1}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.1});
}

TEST(LastingRanges, AWallDoesNotVanishWithOneMissingVector) {
  LastingRanges ranges(3);
  for (const double near : {0.5, kUnknown, 0.4}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.4});
}

TEST(LastingRanges, MostlyUnknownIsFar) {
  LastingRanges ranges(3);
  EXPECT_TRUE(ranges.lasting_per_m().empty());
  ranges.add({0.5});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.0});
  ranges.add({kUnknown});
  ranges.add({kUnknown});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.0});
}

TEST(LastingRanges, OldImagesAreForgotten) {
  LastingRanges ranges(2);
  for (const double near : {0.1, 0.6, 0.7}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.6});
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
