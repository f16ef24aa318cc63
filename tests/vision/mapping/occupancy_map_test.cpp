#include "vision/mapping/occupancy_map.h"

#include <gtest/gtest.h>

#include "tests/vision/mapping/mapped_world.h"

namespace hedgehop::vision::mapping {
namespace {

using State = OccupancyMap::State;

OccupancyMapConfig small() { return {.voxel_m = 0.3, .across = 100, .layers = 10}; }

/// Flies a few meters through a world with noisy disparities, with views to both sides.
OccupancyMap mapped(const MappedWorld& world, uint64_t seed) {
  std::mt19937_64 generator(seed);
  OccupancyMap map(small());
  DepthBlocks blocks;
  Eigen::Vector3d p_WC(0.0, 0.0, -1.5);
  map.reset(p_WC);
  for (int i = 0; i < 16; ++i) {
    const Eigen::Isometry3d X_WC = MappedWorld::looking(p_WC, 0.5 * std::sin(0.7 * i));
    blocks.build(world.disparity16(X_WC, generator), {}, 0);
    map.move(p_WC);
    map.integrate(blocks, world.geometry, X_WC);
    p_WC.x() += 0.09;
  }
  return map;
}

struct Counts {
  int in_solid = 0, free_in_solid = 0, free = 0, occupied = 0, occupied_near_surface = 0;
};

/// Compares the map with the boxes. A voxel is solid if its center is inside a box.
Counts compare(const OccupancyMap& map, const MappedWorld& world) {
  Counts counts;
  for (int z = map.first().z(); z < map.first().z() + map.size().z(); ++z) {
    for (int x = map.first().x(); x < map.first().x() + map.size().x(); ++x) {
      for (int y = map.first().y(); y < map.first().y() + map.size().y(); ++y) {
        const State state = map.state({x, y, z});
        const Eigen::Vector3d center_W = map.center({x, y, z});
        if (center_W.z() > -map.config().voxel_m) continue;  // the ground
        const bool solid = world.holds(center_W);
        counts.in_solid += solid;
        counts.free_in_solid += solid && state == State::free;
        counts.free += state == State::free;
        if (state != State::occupied) continue;
        ++counts.occupied;
        for (const Eigen::AlignedBox3d& box : world.boxes_W) {
          if (box.exteriorDistance(center_W) > 0.9) continue;
          ++counts.occupied_near_surface;
          break;
        }
      }
    }
  }
  return counts;
}

TEST(OccupancyMap, MarksNoSolidVoxelFreeWithoutNoise) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const MappedWorld world = MappedWorld::random(seed);
    const Counts counts = compare(mapped(world, seed), world);
    EXPECT_GT(counts.in_solid, 500) << seed;
    EXPECT_GT(counts.free, 5000) << seed;
    EXPECT_EQ(counts.free_in_solid, 0) << seed;
  }
}

TEST(OccupancyMap, MarksFewSolidVoxelsFreeWithMatcherNoise) {
  constexpr double kRate = 0.001;  // all 64 pixels of a block err only at long range, at which two sigma are meters
  int solid = 0, wrong = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    MappedWorld world = MappedWorld::random(seed);
    world.noise_px = 0.4;
    const Counts counts = compare(mapped(world, seed), world);
    solid += counts.in_solid;
    wrong += counts.free_in_solid;
  }
  EXPECT_GT(solid, 3000);
  EXPECT_LE(wrong, kRate * solid);
}

TEST(OccupancyMap, OccupiedVoxelsAreAtSurfaces) {
  int occupied = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const MappedWorld world = MappedWorld::random(seed);
    const Counts counts = compare(mapped(world, seed), world);
    occupied += counts.occupied;
    EXPECT_EQ(counts.occupied_near_surface, counts.occupied) << seed;
  }
  EXPECT_GT(occupied, 200);
}

TEST(OccupancyMap, WithoutMatchesAllVoxelsAreUnknown) {
  OccupancyMap map(small());
  map.reset(Eigen::Vector3d::Zero());
  DepthBlocks blocks;
  blocks.build(cv::Mat(180, 320, CV_16SC1, cv::Scalar(stereo::kNoDisparity)), {}, 0);
  const MappedWorld world;
  for (int i = 0; i < 20; ++i)
    map.integrate(blocks, world.geometry, MappedWorld::looking(Eigen::Vector3d::Zero(), 0.0));
  for (int x = -50; x < 50; ++x) {
    for (int z = -5; z < 5; ++z) EXPECT_EQ(map.state({x, 0, z}), State::unknown);
  }
}

TEST(OccupancyMap, MoveKeepsVoxelsInsideAndClearsTheOthers) {
  OccupancyMap map(small());
  map.reset(Eigen::Vector3d::Zero());
  const Eigen::Vector3d near_W(3.0, 2.0, 0.0), far_W(-13.0, 2.0, 0.0);
  for (const Eigen::Vector3d& p_W : {near_W, far_W}) map.clear_cylinder(p_W, 0.5, 0.3);
  map.move({6.0, -4.0, 0.4});
  EXPECT_EQ(map.state(map.index(near_W)), State::free);
  EXPECT_EQ(map.state(map.index(far_W)), State::unknown);
  map.move({0.0, 0.0, 0.0});  // there and back: voxels that left are cleared
  EXPECT_EQ(map.state(map.index(near_W)), State::free);
  EXPECT_EQ(map.state(map.index(far_W)), State::unknown);
}

// A box that crosses the view at 1 m/s, in space observed as free before.
TEST(OccupancyMap, KnownMovingObstaclesLeaveNoTrail) {
  const auto not_free_behind = [](bool known) {
    OccupancyMap map(small());
    std::mt19937_64 generator(1);
    DepthBlocks blocks;
    const Eigen::Vector3d eye_W(0.0, 0.0, -1.5);
    const Eigen::Isometry3d X_WC = MappedWorld::looking(eye_W, 0.0);
    map.reset(eye_W);
    double east_m = 0.0;
    for (int image = 0; image < 30; ++image) {
      MappedWorld world;
      std::vector<OccupancyMap::MovingDisc> moving;
      if (image >= 10) {
        east_m = 0.1 * (image - 20);
        world.boxes_W = {{Eigen::Vector3d(3.0, east_m - 0.5, -4.0), Eigen::Vector3d(4.0, east_m + 0.5, 0.0)}};
        if (known) moving = {{{3.5, east_m}, 1.0}};
      }
      blocks.build(world.disparity16(X_WC, generator), {}, 0);
      map.integrate(blocks, world.geometry, X_WC, moving);
    }
    int count = 0;
    for (double x = 2.55; x < 4.0; x += 0.3) {
      for (double y = east_m - 1.4; y < east_m - 0.8; y += 0.3) {
        count += map.state(map.index({x, y, -1.5})) != State::free;
      }
    }
    return count;
  };
  EXPECT_GT(not_free_behind(false), 0);
  EXPECT_EQ(not_free_behind(true), 0);
}

TEST(OccupancyMap, RowsAreTheStatesOfTheirVoxels) {
  const MappedWorld world = MappedWorld::random(3);
  const OccupancyMap map = mapped(world, 3);
  std::vector<State> row;
  for (int layer = 0; layer < map.size().z(); ++layer) {
    map.read_row(layer, 40, row);
    for (int i = 0; i < map.size().y(); ++i) {
      EXPECT_EQ(row[static_cast<size_t>(i)], map.state(map.first() + OccupancyMap::Index(40, i, layer)));
    }
  }
}

TEST(OccupancyMap, FadesToUnknown) {
  OccupancyMap map(small());
  map.reset(Eigen::Vector3d::Zero());
  map.clear_cylinder(Eigen::Vector3d::Zero(), 0.5, 0.3);
  for (int i = 0; i < 12; ++i) map.fade();
  EXPECT_EQ(map.state(map.index(Eigen::Vector3d::Zero())), State::unknown);
}

}  // namespace
}  // namespace hedgehop::vision::mapping
