#include "avoidance/local_map/learned_distances.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kCellM = 0.5, kNeedM = 0.5;
const Eigen::Vector3d goal_W(40.0, 0.0, 0.0);

/// A map of 24 m in the open, or with a wall across it north of the vehicle; field and slice live as long as it.
struct Known {
  explicit Known(bool walled, const LearnedDistances& learned) {
    vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 48, .layers = 1});
    map.reset(Eigen::Vector3d::Zero());
    ClosedCells closed(kCellM);
    if (walled) {
      for (double east_m = -11.9; east_m < 12.0; east_m += kCellM) closed.remember({4.1, east_m, 0.1}, 0.0);
      map.clear_cylinder({-8.0, 0.0, 0.0}, 11.5, 1.0);
    } else {
      map.clear_cylinder(Eigen::Vector3d::Zero(), 100.0, 1.0);
    }
    slice.build(map, {-0.1, 0.3}, closed);
    field.build(slice, {kNeedM, kNeedM}, goal_W.head<2>(), learned.beyond_m(goal_W.head<2>(), 0.0));
  }
  LevelSlice slice;
  RouteField field;
};

TEST(LearnedDistances, InTheOpenTheyAreTheStraightLine) {
  LearnedDistances learned;
  const Known open(false, learned);
  learned.learn(open.field, open.slice, Eigen::Vector3d::Zero(), goal_W);
  for (const Eigen::Vector2d& at_W :
       {Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(-4.5, 4.5), Eigen::Vector2d(7.5, -7.5)}) {
    const double straight_m = (goal_W.head<2>() - at_W).norm();
    constexpr double kOctile = 1.09;  // an eight-connected grid is that much longer at most
    EXPECT_GE(learned.at_least_m(at_W, 0.0), straight_m - kCellM);
    EXPECT_LE(learned.at_least_m(at_W, 0.0), kOctile * straight_m);
  }
  EXPECT_EQ(learned.at_least_m({100.0, 0.0}, 0.0), 0.0);
}

TEST(LearnedDistances, NeverFallWhenTheMapForgets) {
  LearnedDistances learned;
  const Known walled(true, learned);
  learned.learn(walled.field, walled.slice, Eigen::Vector3d::Zero(), goal_W);
  const Eigen::Vector2d at_W(1.5, 1.5);
  const double found_m = learned.at_least_m(at_W, 0.0);
  EXPECT_GT(found_m, (goal_W.head<2>() - at_W).norm() + 8.0);  // round an end of the wall, 10 m aside
  const Known forgotten(false, learned);
  learned.learn(forgotten.field, forgotten.slice, Eigen::Vector3d::Zero(), goal_W);
  EXPECT_EQ(learned.at_least_m(at_W, 0.0), found_m);
}

TEST(LearnedDistances, CountAtOtherHeightsLessTheClimbAndForNoOtherGoal) {
  LearnedDistances learned;
  const Known walled(true, learned);
  learned.learn(walled.field, walled.slice, Eigen::Vector3d::Zero(), goal_W);
  const Eigen::Vector2d at_W(1.5, 1.5);
  const double here_m = learned.at_least_m(at_W, 0.0), above_m = learned.at_least_m(at_W, -2.4);
  EXPECT_LT(above_m, here_m);
  EXPECT_GT(above_m, 0.0);
  const Known open(false, {});
  learned.learn(open.field, open.slice, Eigen::Vector3d::Zero(), goal_W + Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_LT(learned.at_least_m(at_W, 0.0), here_m);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
