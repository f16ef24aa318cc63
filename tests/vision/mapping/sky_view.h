#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/vision/mapping/mapped_world.h"
#include "vision/mapping/depth_blocks.h"

namespace hedgehop::vision::mapping {

inline constexpr int kGroundGrey = 90, kSkyGrey = 170, kBoxGrey = 120;

/// Disparity of a matcher for textured ground, untextured boxes and sky: unknown on untextured surfaces and on ground
/// beyond 60 m.
struct SkyView {
  MappedWorld world;
  cv::Mat disparity16, grey;
  std::vector<uint8_t> is_sky, is_blank;  ///< of each pixel, by ray
  Eigen::Isometry3d X_WC;

  DepthBlocks blocks() const {
    DepthBlocks blocks;
    blocks.build(disparity16, grey, 0);
    find_sky(world.geometry, X_WC.linear().row(2).transpose(), blocks);
    return blocks;
  }
};

inline SkyView look(const MappedWorld& world, double height_m, const std::vector<Eigen::AlignedBox3d>& blank_W,
                    double pitch_rad = 0.0, double roll_rad = 0.0) {
  const Eigen::Isometry3d X_WC = MappedWorld::looking({0.0, 0.0, -height_m}, 0.0, pitch_rad) *
                                 Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
  SkyView view{world,
               cv::Mat(world.height_px, world.width_px, CV_16SC1),
               cv::Mat(world.height_px, world.width_px, CV_8UC1),
               {},
               {},
               X_WC};
  MappedWorld with = world;
  with.boxes_W.insert(with.boxes_W.end(), blank_W.begin(), blank_W.end());
  constexpr double kMatchedM = 60.0;
  for (int v = 0; v < world.height_px; ++v) {
    for (int u = 0; u < world.width_px; ++u) {
      const Eigen::Vector3d ray_W = X_WC.linear() * world.geometry.ray_at_unit_depth({u, v});
      const double bare_m = world.cast(X_WC.translation(), ray_W), z_m = with.cast(X_WC.translation(), ray_W);
      const bool blank = z_m < bare_m, sky = std::isinf(z_m);
      view.grey.at<uint8_t>(v, u) = static_cast<uint8_t>(sky ? kSkyGrey : blank ? kBoxGrey : kGroundGrey);
      view.disparity16.at<int16_t>(v, u) = sky || blank || z_m > kMatchedM
                                               ? stereo::kNoDisparity
                                               : static_cast<int16_t>(std::lround(world.geometry.disparity16(z_m)));
      view.is_sky.push_back(sky);
      view.is_blank.push_back(blank);
    }
  }
  return view;
}

}  // namespace hedgehop::vision::mapping
