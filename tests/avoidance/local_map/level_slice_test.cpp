#include "avoidance/local_map/level_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>
#include <utility>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::avoidance::local_map {
namespace {

using State = LevelSlice::State;

TEST(ClosedCells, CloseOnlyUnknownColumnsForALimitedTime) {
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
  EXPECT_EQ(at(2.1, 0.1), State::free);  // observation has priority
  EXPECT_EQ(at(2.1, 1.3), State::occupied);
  EXPECT_EQ(at(2.1, 2.3), State::unknown);
  slice.build(map, {-1.0, -0.2}, closed);  // another level
  EXPECT_EQ(slice.at(slice.cell({2.1, 1.3}).x(), slice.cell({2.1, 1.3}).y()), State::unknown);
  EXPECT_EQ(at(2.1, 3.1), State::occupied);
  closed.update(3.0 + ClosedCells::kUnknownS + 1.0);
  EXPECT_EQ(at(2.1, 1.3), State::unknown);
  EXPECT_EQ(at(2.1, 3.1), State::occupied);  // observed cells are kept longer
  closed.update(3.0 + ClosedCells::kOccupiedS + 1.0);
  EXPECT_EQ(at(2.1, 3.1), State::unknown);
}

TEST(LevelSlice, SingleUnknownColumnBetweenFreeOnesIsFreeAndTwoAreNot) {
  constexpr double kCellM = 0.5;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 20, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  const std::vector<std::pair<int, int>> unknown = {{5, 5}, {10, 10}, {10, 11}, {14, 4}, {15, 5}};
  for (int row = 0; row < 20; ++row) {
    for (int col = 0; col < 20; ++col) {
      if (std::ranges::find(unknown, std::pair{row, col}) != unknown.end()) continue;
      map.clear_cylinder(map.center(map.first() + vision::mapping::OccupancyMap::Index(row, col, 0)), 0.1, 0.1);
    }
  }
  LevelSlice slice;
  ClosedCells closed(kCellM);
  slice.build(map, {0.1, 0.4}, closed);
  for (const auto& [row, col] : unknown) {
    EXPECT_EQ(slice.at(row, col), row == 5 ? State::free : State::unknown) << row << " " << col;
  }
  closed.remember(map.center(map.first() + vision::mapping::OccupancyMap::Index(5, 5, 0)), 0.0);
  slice.build(map, {0.1, 0.4}, closed);
  EXPECT_EQ(slice.at(5, 5), State::occupied);
}

// A thin pole may be matched only once.
TEST(LevelSlice, ObservedSurfaceBetweenFreeColumnsIsNotFree) {
  constexpr double kCellM = 0.5, kPoleM = 2.25;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 20, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  const Eigen::Vector3d pole_W(kPoleM, 0.1, 0.1);
  for (int row = 0; row < 20; ++row) {
    for (int col = 0; col < 20; ++col) {
      const vision::mapping::OccupancyMap::Index voxel =
          map.first() + vision::mapping::OccupancyMap::Index(row, col, 0);
      if (voxel != map.index(pole_W)) map.clear_cylinder(map.center(voxel), 0.1, 0.1);
    }
  }
  LevelSlice slice;
  const auto at_pole = [&] {
    slice.build(map, {0.1, 0.4}, ClosedCells(kCellM));
    const Eigen::Vector2i cell = slice.cell(pole_W.head<2>());
    return slice.at(cell.x(), cell.y());
  };
  EXPECT_EQ(at_pole(), State::free);
  const vision::stereo::StereoGeometry geometry{
      .focal_px = 100.0, .center_u_px = 4.0, .center_v_px = 4.0, .baseline_m = 0.25};
  vision::mapping::DepthBlocks blocks;
  blocks.build(cv::Mat(8, 8, CV_16SC1, cv::Scalar(std::round(geometry.disparity16(kPoleM)))), {}, 0);
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  X_WC.translation() = Eigen::Vector3d(0.0, 0.1, 0.1);
  map.integrate(blocks, geometry, X_WC);
  EXPECT_EQ(at_pole(), State::unknown);
}

// Compared with points of the cells, 2 cm apart.
TEST(LevelSlice, ExactDistanceIsThatToTheNearestPointOfAnOccupiedCell) {
  constexpr double kCellM = 0.5, kStepM = 0.02, kWithinM = 1.2;
  constexpr int kSide = 12;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = kSide, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  std::mt19937_64 random(5);
  ClosedCells closed(kCellM);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const Eigen::Vector3d p_W = map.center(map.first() + vision::mapping::OccupancyMap::Index(row, col, 0));
      if (chance(random, 0.05)) closed.remember(p_W, 0.0);
    }
  }
  LevelSlice slice;
  slice.build(map, {0.1, 0.4}, closed);
  const auto nearest_m = [&](const Eigen::Vector2d& p_W) {
    double least_m = std::numeric_limits<double>::infinity();
    for (int row = 0; row < kSide; ++row) {
      for (int col = 0; col < kSide; ++col) {
        if (slice.at(row, col) != State::occupied) continue;
        for (double x = -0.5 * kCellM; x <= 0.5 * kCellM + 1e-9; x += kStepM) {
          for (double y = -0.5 * kCellM; y <= 0.5 * kCellM + 1e-9; y += kStepM) {
            least_m = std::min(least_m, (slice.center(row, col) + Eigen::Vector2d(x, y) - p_W).norm());
          }
        }
      }
    }
    return least_m;
  };
  int inside = 0, near = 0, far = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p_W =
        slice.center(0, 0) + (kSide - 1) * kCellM * Eigen::Vector2d(uniform(random), uniform(random));
    const Eigen::Vector2i cell = slice.cell(p_W);
    const double expected_m = nearest_m(p_W), actual_m = slice.exactly_to_occupied_m(p_W, kWithinM);
    if (slice.at(cell.x(), cell.y()) == State::occupied) {
      EXPECT_LE(actual_m, 0.0);
      EXPECT_GE(actual_m, -0.5 * kCellM);
      ++inside;
    } else if (expected_m <= kWithinM) {
      EXPECT_NEAR(actual_m, expected_m, kStepM) << p_W.transpose();
      ++near;
    } else {
      EXPECT_GT(actual_m, kWithinM) << p_W.transpose();
      ++far;
    }
  }
  EXPECT_GT(std::min({inside, near, far}), 10) << inside << " " << near << " " << far;
  EXPECT_EQ(slice.exactly_to_occupied_m(slice.center(0, 0) - Eigen::Vector2d::Constant(5.0), kWithinM), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
