#include "avoidance/flow_balance/visited_floor.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::flow_balance {
namespace {

TEST(VisitedFloor, CountsTheSquaresThatAPathEnters) {
  const VisitedFloor floor(1.0);
  EXPECT_EQ(floor.unvisited({0.5, 0.5}, {1.0, 0.0}, 3.0), 4);
  EXPECT_EQ(floor.unvisited({-0.5, -0.5}, {0.0, -1.0}, 2.0), 3);
  EXPECT_EQ(floor.unvisited({0.5, 0.5}, {1.0, 0.0}, 0.0), 1);
}

TEST(VisitedFloor, DoesNotCountVisitedSquares) {
  VisitedFloor floor(1.0);
  for (double north_m = 0.0; north_m < 3.0; north_m += 0.1) floor.visit({north_m, 0.5});
  EXPECT_EQ(floor.unvisited({0.5, 0.5}, {1.0, 0.0}, 5.0), 2);  // the fifth and the sixth
  EXPECT_EQ(floor.unvisited({2.5, 0.5}, {-1.0, 0.0}, 2.0), 0);
  EXPECT_EQ(floor.unvisited({0.5, 1.5}, {1.0, 0.0}, 2.0), 3);  // the next row
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
