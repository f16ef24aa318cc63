#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "vision/mapping/depth_blocks.h"
#include "vision/mapping/occupancy_map.h"

namespace hedgehop::vision::mapping {

/// Boxes on level ground at z = 0, and their disparity by casting a ray through every pixel.
struct MappedWorld {
  std::vector<Eigen::AlignedBox3d> boxes_W;
  stereo::StereoGeometry geometry{160.0, 159.5, 89.5, 0.25};
  int width_px = 320, height_px = 180;
  double noise_px = 0.0;

  static MappedWorld random(uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> north(2.0, 20.0), east(-10.0, 10.0), half(0.15, 1.2), high(1.0, 6.0);
    MappedWorld world;
    for (int i = 0; i < 12; ++i) {
      const double x = north(generator), y = east(generator), h = half(generator);
      world.boxes_W.push_back({Eigen::Vector3d(x - h, y - h, -high(generator)), Eigen::Vector3d(x + h, y + h, 0.0)});
    }
    return world;
  }

  bool holds(const Eigen::Vector3d& p_W) const {
    for (const Eigen::AlignedBox3d& box : boxes_W) {
      if (box.contains(p_W)) return true;
    }
    return false;
  }

  /// Distance along a ray in units of its length.
  double cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W) const {
    double nearest = ray_W.z() > 0.0 ? -p_W.z() / ray_W.z() : std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& box : boxes_W) {
      const Eigen::Array3d a = (box.min() - p_W).array() / ray_W.array();
      const Eigen::Array3d b = (box.max() - p_W).array() / ray_W.array();
      const double enters = a.min(b).maxCoeff(), leaves = a.max(b).minCoeff();
      if (enters > 0.0 && enters <= leaves) nearest = std::min(nearest, enters);
    }
    return nearest;
  }

  /// Pose of C at an altitude, looking north, rotated by a heading and pitched up.
  static Eigen::Isometry3d looking(const Eigen::Vector3d& p_W, double heading_rad, double pitch_rad = 0.0) {
    Eigen::Isometry3d X_WC(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()));
    Eigen::Matrix3d R_BC;
    R_BC << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    X_WC.linear() = X_WC.linear() * R_BC;
    X_WC.translation() = p_W;
    return X_WC;
  }

  cv::Mat disparity16(const Eigen::Isometry3d& X_WC, std::mt19937_64& generator) const {
    std::normal_distribution<double> error(0.0, std::max(1e-12, noise_px));
    cv::Mat disparity(height_px, width_px, CV_16SC1);
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) {
        const double z_m = cast(X_WC.translation(), X_WC.linear() * geometry.ray_at_unit_depth({u, v}));
        const double exact = std::isfinite(z_m) ? geometry.disparity16(z_m) : 0.0;
        disparity.at<int16_t>(v, u) =
            static_cast<int16_t>(std::max(0.0, std::round(exact + stereo::kDisparityUnits * error(generator))));
      }
    }
    return disparity;
  }
};

}  // namespace hedgehop::vision::mapping
