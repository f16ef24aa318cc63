#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "vision/camera/pinhole_camera.h"

namespace hedgehop::vision::motion {

/// A textured world, imaged by ray casting without any renderer: a level ground, a wall across and a box in front of
/// it. Frame W: x north, y east, z down.
struct CastWorld {
  double ground_m = 1.5;  ///< z of the ground
  double wall_m = 9.0;    ///< x of the wall
  Eigen::AlignedBox3d box{Eigen::Vector3d(4.0, 0.4, -0.8), Eigen::Vector3d(5.0, 1.6, 1.5)};
  double contrast = 1.0;

  struct Seen {
    double grey = 0.0;
    double range = std::numeric_limits<double>::infinity();  ///< along the ray, in its lengths
  };

  /// @param ray_W  of any length.
  Seen cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W) const {
    double range = (wall_m - p_W.x()) / ray_W.x();
    if (ray_W.z() > 0.0) range = std::min(range, (ground_m - p_W.z()) / ray_W.z());
    const Eigen::Array3d a = (box.min() - p_W).array() / ray_W.array(), b = (box.max() - p_W).array() / ray_W.array();
    const double enters = a.min(b).maxCoeff(), leaves = a.max(b).minCoeff();
    if (enters > 0.0 && enters < leaves) range = std::min(range, enters);
    return {texture(p_W + range * ray_W), range};
  }

  /// Grey of a surface point: waves of 0.15 to 1 m in directions without order.
  double texture(const Eigen::Vector3d& p_W) const {
    double grey = 0.0;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d direction(std::sin(1.0 + 2.3 * i), std::sin(2.0 + 3.7 * i), std::sin(4.0 + 1.9 * i));
      grey += 14.0 * std::sin(2.0 * M_PI / (0.15 + 0.08 * i) * direction.normalized().dot(p_W) + i);
    }
    return std::clamp(125.0 + contrast * grey, 5.0, 250.0);
  }

  struct Image {
    cv::Mat grey;   ///< CV_8UC1
    cv::Mat per_m;  ///< CV_32FC1, inverse depth, 1/m
  };
  /// @param noise_grey  1-sigma of the noise of a pixel. Each pixel is the mean of two rays.
  Image image(const camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, double noise_grey,
              std::mt19937_64& generator) const {
    std::normal_distribution<double> noise(0.0, noise_grey);
    Image image{cv::Mat(camera.height_px, camera.width_px, CV_8UC1),
                cv::Mat(camera.height_px, camera.width_px, CV_32FC1)};
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        double grey = 0.0;
        for (const Eigen::Vector2d& off : {Eigen::Vector2d(-0.25, -0.15), Eigen::Vector2d(0.25, 0.15)}) {
          const Eigen::Vector3d ray_C = camera.ray_at_unit_depth(Eigen::Vector2d(u, v) + off);
          grey += 0.5 * cast(X_WC.translation(), X_WC.linear() * ray_C).grey;
        }
        image.grey.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(grey + (noise_grey > 0.0 ? noise(generator) : 0.0));
        const Seen middle = cast(X_WC.translation(), X_WC.linear() * camera.ray_at_unit_depth(Eigen::Vector2d(u, v)));
        image.per_m.at<float>(v, u) = static_cast<float>(1.0 / middle.range);
      }
    }
    return image;
  }

  /// Returns the pose of a camera that looks north. @param turn  rotation in W that follows.
  static Eigen::Isometry3d looking_north(const Eigen::Vector3d& p_WC,
                                         const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    Eigen::Matrix3d R_BC;
    R_BC << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
    X_WC.linear() = turn * R_BC;
    X_WC.translation() = p_WC;
    return X_WC;
  }
};

}  // namespace hedgehop::vision::motion
