#include "avoidance/local_map/unknown_target.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::local_map {
namespace {

// Cells that remain unknown despite observation from several positions are finally closed.
TEST(ProgressTimer, CountsFromTheLastDecreaseOfTheRoute) {
  ProgressTimer progress;
  EXPECT_EQ(progress.stalled_s(std::nullopt, 1.0), 0.0);
  EXPECT_EQ(progress.stalled_s(30.0, 2.0), 0.0);
  EXPECT_EQ(progress.stalled_s(29.5, 5.0), 3.0);
  EXPECT_EQ(progress.stalled_s(31.5, 6.0), 4.0);
  EXPECT_EQ(progress.stalled_s(std::nullopt, 7.0), 5.0);
  EXPECT_EQ(progress.stalled_s(28.5, 8.0), 0.0);   // shorter
  EXPECT_EQ(progress.stalled_s(60.0, 10.0), 0.0);  // another route
  EXPECT_EQ(progress.stalled_s(60.0, 12.0), 2.0);
  progress.reset();
  EXPECT_EQ(progress.stalled_s(60.0, 13.0), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
