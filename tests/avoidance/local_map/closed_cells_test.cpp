#include "avoidance/local_map/closed_cells.h"

#include <gtest/gtest.h>

#include "avoidance/local_map/level_slice.h"

namespace hedgehop::avoidance::local_map {
namespace {

using State = LevelSlice::State;

TEST(ClosedCells, OnlyUnknownColumnsAreClosedAndOnlyForATime) {
  vision::mapping::OccupancyMap map({.voxel_m = 0.5, .across = 20, .layers = 4});
  map.reset(Eigen::Vector3d::Zero());
  map.clear_cylinder({2.0, 0.0, 0.0}, 0.6, 1.0);
  ClosedCells closed(0.5);
  closed.close({2.0, 0.5, 0.1}, 1.2, 3.0);
  closed.remember({2.1, 3.1, 0.1}, 3.0);
  LevelSlice slice;
  const auto at = [&](double north_m, double east_m) {
    slice.build(map, {-0.4, 0.4}, closed);
    const Eigen::Vector2i cell = slice.cell({north_m, east_m});
    return slice.at(cell.x(), cell.y());
  };
  EXPECT_EQ(at(2.1, 0.1), State::free);  // what was seen counts
  EXPECT_EQ(at(2.1, 1.3), State::occupied);
  EXPECT_EQ(at(2.1, 2.3), State::unknown);
  slice.build(map, {-1.0, -0.2}, closed);  // another level
  EXPECT_EQ(slice.at(slice.cell({2.1, 1.3}).x(), slice.cell({2.1, 1.3}).y()), State::unknown);
  EXPECT_EQ(at(2.1, 3.1), State::occupied);
  closed.update(3.0 + ClosedCells::kUnknownS + 1.0);
  EXPECT_EQ(at(2.1, 1.3), State::unknown);
  EXPECT_EQ(at(2.1, 3.1), State::occupied);  // what was seen is kept for longer
  closed.update(3.0 + ClosedCells::kOccupiedS + 1.0);
  EXPECT_EQ(at(2.1, 3.1), State::unknown);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
