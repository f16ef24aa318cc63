#include "vision/mapping/find_plain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/vision/mapping/mapped_world.h"

namespace hedgehop::vision::mapping {
namespace {

constexpr int kFloorGrey = 90, kWallGrey = 150;

struct PlainBox {
  Eigen::AlignedBox3d box_W;
  int grey;
};

/// Images of textured ground and plain boxes. Ground is matched within 40 m. Boxes and sky are unmatched, but as from a
/// matcher with a window of 11 px, the disparity of ground continues for 5 px on the box above it, and upright sides of
/// boxes are matched.
struct PlainView {
  static constexpr int kHalfWindowPx = 5;
  static constexpr double kMatchedM = 40.0;

  MappedWorld world;
  Eigen::Isometry3d X_WC;
  cv::Mat disparity16, grey;
  std::vector<int16_t> of_box16;  ///< true disparity x 16 of each pixel of a box

  PlainView(const std::vector<PlainBox>& boxes, double height_m, double pitch_rad = 0.0, double roll_rad = 0.0)
      : X_WC(MappedWorld::looking({0.0, 0.0, -height_m}, 0.0, pitch_rad) *
             Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ())),
        disparity16(world.height_px, world.width_px, CV_16SC1, cv::Scalar(stereo::kNoDisparity)),
        grey(world.height_px, world.width_px, CV_8UC1, cv::Scalar(220)) {
    for (int v = 0; v < world.height_px; ++v) {
      for (int u = 0; u < world.width_px; ++u) draw(boxes, u, v);
    }
    cv::Mat noise(grey.size(), CV_16SC1), noisy;
    cv::RNG generator(1);
    constexpr double kSigma = 3.0;  // grey levels
    generator.fill(noise, cv::RNG::NORMAL, 0.0, kSigma);
    grey.convertTo(noisy, CV_16SC1);
    noisy += noise;
    noisy.convertTo(grey, CV_8UC1);
    for (int u = 0; u < world.width_px; ++u) smear(u);
    for (int v = 0; v < world.height_px; ++v) match_sides(v);
  }

  DepthBlocks blocks() const {
    DepthBlocks blocks;
    blocks.build(disparity16, grey, kHalfWindowPx);
    find_plain(world.geometry, X_WC.linear().row(2).transpose(), disparity16, grey, blocks);
    return blocks;
  }

 private:
  void draw(const std::vector<PlainBox>& boxes, int u, int v) {
    const Eigen::Vector3d ray_W = X_WC.linear() * world.geometry.ray_at_unit_depth({u, v});
    double nearest_m = world.cast(X_WC.translation(), ray_W);
    if (nearest_m < kMatchedM) {
      const Eigen::Vector3d ground_W = X_WC.translation() + nearest_m * ray_W;
      const int cell = static_cast<int>(std::floor(3.0 * ground_W.x()) + std::floor(3.0 * ground_W.y()));
      grey.at<uint8_t>(v, u) = static_cast<uint8_t>(kFloorGrey + (cell % 2 == 0 ? 20 : -20));
      disparity16.at<int16_t>(v, u) = static_cast<int16_t>(std::lround(world.geometry.disparity16(nearest_m)));
    }
    for (const PlainBox& box : boxes) {
      MappedWorld only;
      only.boxes_W = {box.box_W};
      const double box_m = only.cast(X_WC.translation(), ray_W);
      if (!(box_m < nearest_m)) continue;
      nearest_m = box_m;
      grey.at<uint8_t>(v, u) = static_cast<uint8_t>(box.grey);
      disparity16.at<int16_t>(v, u) = stereo::kNoDisparity;
    }
    of_box16.push_back(nearest_m < world.cast(X_WC.translation(), ray_W)
                           ? static_cast<int16_t>(std::lround(world.geometry.disparity16(nearest_m)))
                           : stereo::kNoDisparity);
  }

  /// The upright sides of boxes are matched, within half a window.
  void match_sides(int v) {
    constexpr int kSide16 = 16;  // minimum step of disparity
    const auto at = [&](int u) { return of_box16[static_cast<size_t>(v * world.width_px + u)]; };
    for (int u = 1; u < world.width_px; ++u) {
      const int16_t nearer16 = std::max(at(u), at(u - 1));
      if (std::abs(at(u) - at(u - 1)) < kSide16) continue;
      for (int i = std::max(0, u - kHalfWindowPx); i < std::min(world.width_px, u + kHalfWindowPx); ++i) {
        disparity16.at<int16_t>(v, i) = nearer16;
      }
    }
  }

  void smear(int u) {
    for (int v = 1; v < world.height_px; ++v) {
      const int16_t below16 = disparity16.at<int16_t>(v, u);
      if (below16 < 0 || disparity16.at<int16_t>(v - 1, u) >= 0) continue;
      for (int up = 1; up <= std::min(v, kHalfWindowPx); ++up) disparity16.at<int16_t>(v - up, u) = below16;
    }
  }
};

/// The map of a few equal images, compared with the true view.
struct Mapped {
  int plain = 0, standing = 0;    ///< blocks
  int free = 0, occupied = 0;     ///< voxels in a strip of 2 m ahead, at the altitude of the camera
  double farthest_free_m = -1e9;  ///< maximum length of a ray to a free voxel behind the first surface
};

Mapped map_of(const PlainView& view, const std::vector<PlainBox>& boxes) {
  MappedWorld solid = view.world;
  for (const PlainBox& box : boxes) solid.boxes_W.push_back(box.box_W);
  const DepthBlocks blocks = view.blocks();
  Mapped mapped;
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      mapped.plain += blocks.at(row, col).kind == DepthBlock::Kind::plain;
      mapped.standing += blocks.at(row, col).stands;
    }
  }
  OccupancyMap map{{}};
  const Eigen::Vector3d camera_W = view.X_WC.translation();
  map.reset(camera_W);
  for (int image = 0; image < 5; ++image) map.integrate(blocks, view.world.geometry, view.X_WC);
  const OccupancyMap::Index size = map.size();
  for (int x = 0; x < size.x(); ++x) {
    for (int y = 0; y < size.y(); ++y) {
      for (int z = 0; z < size.z(); ++z) {
        const OccupancyMap::Index voxel = map.first() + OccupancyMap::Index(x, y, z);
        const OccupancyMap::State state = map.state(voxel);
        const Eigen::Vector3d off_W = map.center(voxel) - camera_W;
        if (std::abs(off_W.z()) < 0.2 && std::abs(off_W.y()) < 1.0) {
          mapped.free += state == OccupancyMap::State::free;
          mapped.occupied += state == OccupancyMap::State::occupied;
        }
        if (state != OccupancyMap::State::free) continue;
        mapped.farthest_free_m = std::max(mapped.farthest_free_m, (1.0 - solid.cast(camera_W, off_W)) * off_W.norm());
      }
    }
  }
  return mapped;
}

PlainBox wall_across(double ahead_m, int grey = kWallGrey) {
  return {{Eigen::Vector3d(ahead_m, -60.0, -30.0), Eigen::Vector3d(ahead_m + 1.0, 60.0, 0.0)}, grey};
}

// A voxel is free if its center is in front of a surface by half an edge along z in C. The ray to its center differs
// from those of its corners.
constexpr double kVoxelM = 0.3;

TEST(FindPlain, WallAcrossTheViewIsFreeUpToItsFoot) {
  for (const double ahead_m : {4.0, 6.0, 9.0, 12.0}) {
    const std::vector<PlainBox> wall = {wall_across(ahead_m)};
    const Mapped mapped = map_of(PlainView(wall, 1.5), wall);
    EXPECT_GT(mapped.plain, 250) << ahead_m;
    EXPECT_EQ(mapped.standing, mapped.plain) << ahead_m;
    EXPECT_GT(mapped.free, 10) << ahead_m;
    EXPECT_LT(mapped.farthest_free_m, 0.0) << ahead_m;
  }
}

TEST(FindPlain, WallIsOccupiedWithoutBeingObserved) {
  const std::vector<PlainBox> wall = {wall_across(4.0)};
  EXPECT_GT(map_of(PlainView(wall, 1.5), wall).occupied, 3);
}

TEST(FindPlain, ObliqueWallsOfACorridorAreFreeUpToTheirFeet) {
  const std::vector<PlainBox> walls = {
      {{Eigen::Vector3d(-5.0, 1.8, -3.0), Eigen::Vector3d(30.0, 2.2, 0.0)}, kWallGrey},
      {{Eigen::Vector3d(-5.0, -2.2, -3.0), Eigen::Vector3d(30.0, -1.8, 0.0)}, kWallGrey - 10},
      wall_across(14.0, kWallGrey + 20)};
  for (const double roll_rad : {-0.3, 0.0, 0.3}) {
    for (const double pitch_rad : {-0.15, 0.0, 0.1}) {
      const Mapped mapped = map_of(PlainView(walls, 1.5, pitch_rad, roll_rad), walls);
      EXPECT_GT(mapped.plain, 100) << roll_rad << " " << pitch_rad;
      EXPECT_GT(mapped.free, 100) << roll_rad << " " << pitch_rad;
      EXPECT_LT(mapped.farthest_free_m, kVoxelM) << roll_rad << " " << pitch_rad;
    }
  }
}

// The estimated attitude errs; the plane of the ground corrects it.
TEST(FindPlain, AttitudeErrorDoesNotMoveTheWall) {
  const std::vector<PlainBox> wall = {wall_across(6.0)};
  const PlainView view(wall, 1.5);
  for (const double error_rad : {-0.02, 0.02}) {
    PlainView wrong = view;
    wrong.X_WC = view.X_WC * Eigen::AngleAxisd(error_rad, Eigen::Vector3d::UnitX());
    const Mapped mapped = map_of(wrong, wall);
    EXPECT_GT(mapped.plain, 250) << error_rad;
    EXPECT_GT(mapped.free, 100) << error_rad;
    EXPECT_LT(mapped.farthest_free_m, kVoxelM) << error_rad;
  }
}

// A plain box hangs in front of a plain wall. If it covers the foot of the wall, the ground seems to end at the box,
// but the sides of the box are matched.
TEST(FindPlain, HangingPlainBoxIsNotFreedThrough) {
  constexpr double kBesideM = 0.6;  // rays next to the box, whose blocks show it in part
  for (const double ahead_m : {2.0, 3.0, 5.0}) {
    for (const double bottom_m : {-0.9, -1.3, -1.6}) {
      for (const int contrast : {-12, 60}) {
        const std::vector<PlainBox> scene = {
            wall_across(8.0),
            {{Eigen::Vector3d(ahead_m, -0.7, -2.6), Eigen::Vector3d(ahead_m + 0.5, 0.7, bottom_m)},
             kWallGrey + contrast}};
        const Mapped mapped = map_of(PlainView(scene, 1.5), scene);
        EXPECT_GT(mapped.free, 3) << ahead_m << " " << bottom_m << " " << contrast;
        EXPECT_LT(mapped.farthest_free_m, kBesideM) << ahead_m << " " << bottom_m << " " << contrast;
      }
    }
  }
}

TEST(FindPlain, PlainWallThatHidesTheGroundStaysUnknown) {
  EXPECT_EQ(map_of(PlainView({wall_across(1.5)}, 1.5), {}).plain, 0);
}

// A low plain block does not reach the horizon, so no surface is assumed above it.
TEST(FindPlain, LowPlainBlockDoesNotStand) {
  const std::vector<PlainBox> scene = {
      {{Eigen::Vector3d(3.5, -60.0, -0.8), Eigen::Vector3d(4.5, 60.0, 0.0)}, kWallGrey}, wall_across(20.0, 60)};
  const Mapped mapped = map_of(PlainView(scene, 1.5), scene);
  EXPECT_GT(mapped.plain, 0);
  EXPECT_EQ(mapped.standing, 0);
  EXPECT_GT(mapped.free, 5);
  EXPECT_LT(mapped.farthest_free_m, 0.0);
}

}  // namespace
}  // namespace hedgehop::vision::mapping
