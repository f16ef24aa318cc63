#include "avoidance/local_map/footprint.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::local_map {
namespace {

// Two places of one cell, 0.1 and 0.4 m from the obstacle beside it, which a look-up does not tell apart.
TEST(Footprint, KeepsASmallMarginFromWhereTheVehicleIsWithinItsCell) {
  constexpr double kCellM = 0.5, kHullM = 0.3;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 20, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  ClosedCells closed(kCellM);
  closed.remember({0.25, 0.25, 0.1}, 0.0);  // [0, 0.5] m north and east
  LevelSlice slice;
  slice.build(map, {0.1, 0.4}, closed);
  const auto lacks_m = [&](double margin_m, double north_m) {
    Footprint footprint(Outline({8.0, 3.0, kHullM, {}}), {kHullM, margin_m, 0.0}, kCellM);
    footprint.turn(0.0, 0.0);
    return footprint.fault(slice, {0.0, {north_m, 0.25}, Eigen::Vector2d::Zero()}, false).occupied_m;
  };
  EXPECT_NEAR(lacks_m(0.05, 0.6), kHullM + 0.05 - 0.1, 1e-9);
  EXPECT_EQ(lacks_m(0.05, 0.9), 0.0);
  EXPECT_EQ(lacks_m(0.3, 0.6), lacks_m(0.3, 0.9));
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
