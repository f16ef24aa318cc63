#include "sim/mavlink/obstacle_sectors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "avoidance/heading.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr float kFarM = 1e5f;  // a point at infinity, beyond any maximum range

size_t sector_of(double forward_m, double right_m) {
  const double sector = std::atan2(right_m, forward_m) * 180.0 / std::numbers::pi / ObstacleSectors::kWidthDeg;
  return static_cast<size_t>((static_cast<int>(std::floor(sector + 0.5)) + ObstacleSectors::kCount) %
                             ObstacleSectors::kCount);
}

/// Returns the point at depth 1 m on the ray of a pixel, in C.
Eigen::Vector3d at_unit_depth(const vision::camera::Camera& camera, const Eigen::Vector2d& pixel) {
  const std::optional<Eigen::Vector3d> ray = camera.unit_ray(pixel);
  if (!ray) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const bool is_range = !std::holds_alternative<vision::camera::PinholeLens>(camera.lens);
  return is_range ? *ray : *ray / ray->z();
}

}  // namespace

void ObstacleSectors::add_obstacle(double forward_m, double right_m, double range_m) {
  SectorRange& range = ranges_[sector_of(forward_m, right_m)];
  range.nearest_m = std::min(range.nearest_m, range_m);
  range.seen = true;
}

void ObstacleSectors::add_free(double forward_m, double right_m) { ranges_[sector_of(forward_m, right_m)].seen = true; }

void ObstacleSectors::merge(const ObstacleSectors& other) {
  for (size_t i = 0; i < ranges_.size(); ++i) {
    ranges_[i].nearest_m = std::min(ranges_[i].nearest_m, other.ranges_[i].nearest_m);
    ranges_[i].seen = ranges_[i].seen || other.ranges_[i].seen;
  }
}

DepthToSectors::DepthToSectors(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                               const SectorLimits& limits)
    : limits_(limits), p_BC_(X_BC.translation()) {
  if (!(limits.max_m > limits.min_m)) throw std::invalid_argument("max: must be above min");
  rays_B_.reserve(static_cast<size_t>(camera.width_px) * static_cast<size_t>(camera.height_px));
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      rays_B_.push_back((X_BC.linear() * at_unit_depth(camera, Eigen::Vector2d(u, v))).cast<float>());
    }
  }
}

ObstacleSectors DepthToSectors::sectors(const cv::Mat& depth_m, const Eigen::Quaterniond& q_WB_est) const {
  const double heading_rad = avoidance::heading_rad(q_WB_est);
  const Eigen::Matrix3d R_HB =
      Eigen::AngleAxisd(-heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * q_WB_est.toRotationMatrix();
  const Eigen::Matrix3f R = R_HB.cast<float>();
  const Eigen::Vector3f p_HC = (R_HB * p_BC_).cast<float>();
  const auto above_m = static_cast<float>(limits_.above_m), below_m = static_cast<float>(limits_.below_m);
  const auto min_m = static_cast<float>(limits_.min_m), max_m = static_cast<float>(limits_.max_m);

  ObstacleSectors sectors;
  const Eigen::Vector3f* ray_B = rays_B_.data();
  for (int v = 0; v < depth_m.rows; ++v) {
    const float* const depths_m = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; ++u, ++ray_B) {
      const float z_m = std::min(depths_m[u], kFarM);
      if (!(z_m > 0.0f)) continue;  // unknown
      const Eigen::Vector3f to_point = R * *ray_B * z_m, p_H = p_HC + to_point;
      const float range_m = p_H.head<2>().norm();
      const bool is_level = p_H.z() >= -above_m && p_H.z() <= below_m;
      if (is_level && range_m >= min_m && range_m <= max_m) {
        sectors.add_obstacle(p_H.x(), p_H.y(), range_m);
      } else if (range_m > max_m) {
        const Eigen::Vector3f end_H = p_HC + to_point * (max_m / range_m);
        if (end_H.z() >= -above_m && end_H.z() <= below_m) sectors.add_free(end_H.x(), end_H.y());
      }
    }
  }
  return sectors;
}

}  // namespace hedgehop::sim::mavlink
