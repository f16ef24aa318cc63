#include "vision/corridor/corridor_flow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
#include "sim/fields/order_statistics.h"
#include "vision/flow/feature_flow.h"

namespace hedgehop::vision::corridor {

namespace {

std::optional<Region> region_of(const Eigen::Vector3d& ray_B, const CorridorRegions& regions) {
  const double elevation_rad = std::atan2(-ray_B.z(), ray_B.head<2>().norm());
  if (elevation_rad < regions.lowest_rad || elevation_rad > regions.highest_rad) return std::nullopt;
  const double azimuth_rad = std::atan2(ray_B.y(), ray_B.x()), aside_rad = std::abs(azimuth_rad);
  if (aside_rad < regions.ahead_rad) return kAhead;
  if (aside_rad > regions.ahead_rad + regions.segment_rad) return std::nullopt;
  return azimuth_rad < 0.0 ? kLeft : kRight;
}

}  // namespace

std::array<cv::Mat, kRegions> region_masks(const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                                           const CorridorRegions& regions, int rim_px) {
  fields::require_bounds(regions);
  if (!(regions.lowest_rad < regions.highest_rad)) {
    throw fields::InvalidField("highest", "must be above the lowest elevation");
  }
  std::array<cv::Mat, kRegions> masks;
  for (cv::Mat& mask : masks) mask = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  cv::Mat shown = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const auto ray_C = camera.unit_ray({u, v});
      if (!ray_C) continue;
      shown.at<uint8_t>(v, u) = 255;
      const auto region = region_of(X_BC.linear() * *ray_C, regions);
      if (region) masks[*region].at<uint8_t>(v, u) = 255;
    }
  }
  const cv::Mat window = cv::Mat::ones(2 * rim_px + 1, 2 * rim_px + 1, CV_8UC1);
  cv::erode(shown, shown, window, cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  for (cv::Mat& mask : masks) cv::bitwise_and(mask, shown, mask);
  return masks;
}

namespace {

RejectionReason rejection_of(const WallPoint& point, const Eigen::Vector3d& before_H, const Eigen::Vector3d& after_H,
                             const camera::Camera& camera, const CameraMotion& motion, const FlowLimits& limits) {
  if (point.flow_radps < limits.slowest_radps) return RejectionReason::too_slow;
  if (point.flow_radps > limits.fastest_radps) return RejectionReason::too_fast;
  if (flow::direction_error_rad(before_H, after_H, motion.traveled_H) > limits.stray_rad) {
    return RejectionReason::outlier;
  }
  if (point.region != kAhead) {
    const auto center_px = camera.project(Eigen::Vector3d::UnitZ());
    const auto after_px = camera.project(motion.R_HC1.transpose() * after_H);
    if (!center_px || !after_px ||
        flow::off_tangent_rad(point.pair.before_px, *after_px, *center_px) > limits.off_tangent_rad) {
      return RejectionReason::off_tangent;
    }
  }
  return point.p_CP_H.z() > limits.floor_share * motion.height_m ? RejectionReason::floor : RejectionReason::none;
}

}  // namespace

WallPoint wall_point(const flow::RayPair& pair, Region region, const camera::Camera& camera, const CameraMotion& motion,
                     const FlowLimits& limits) {
  const Eigen::Vector3d before_H = motion.R_HC1 * pair.before_C;
  const Eigen::Vector3d after_H =
      motion.R_HC1 * flow::derotate_ray(pair.after_C, motion.R_HC1.transpose() * motion.R_HC2);
  WallPoint point{pair, region};
  point.flow_radps = flow::flow_angle_rad(before_H, after_H) / motion.dt_s;
  point.off_travel_rad = flow::flow_angle_rad(before_H, motion.traveled_H);
  point.contact_s = time_to_contact_s(before_H, after_H, motion.traveled_H, motion.dt_s);
  point.p_CP_H = flow::distance_m(before_H, after_H, motion.traveled_H) * after_H;
  point.rejection = rejection_of(point, before_H, after_H, camera, motion, limits);
  return point;
}

SideDistance side_distance(const std::vector<WallPoint>& points, Region side, int min_count) {
  std::vector<double> asides_m;
  for (const WallPoint& point : points) {
    if (point.region == side && point.rejection == RejectionReason::none)
      asides_m.push_back(std::abs(point.p_CP_H.y()));
  }
  const size_t count = asides_m.size();
  SideDistance found{std::numeric_limits<double>::quiet_NaN(), static_cast<int>(count)};
  if (found.count < std::max(1, min_count)) return found;
  found.distance_m = kth_smallest(asides_m, count / 2);
  if (count % 2 == 0) {
    found.distance_m =
        0.5 * (found.distance_m +
               *std::max_element(asides_m.begin(), asides_m.begin() + static_cast<std::ptrdiff_t>(count / 2)));
  }
  return found;
}

double middle_offset_m(double left_m, double right_m) { return 0.5 * (right_m - left_m); }

double centering_error(double left_m, double right_m) { return (right_m - left_m) / (right_m + left_m); }

double time_to_contact_s(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled,
                         double dt_s) {
  const Eigen::Vector3d way = traveled.normalized();
  const double sin_flow = before.cross(after).norm();
  // D cos(alpha) / v, with D / (v dt) by the law of sines as in distance_m().
  return sin_flow > 0.0 ? dt_s * before.cross(way).norm() * after.dot(way) / sin_flow
                        : std::numeric_limits<double>::infinity();
}

}  // namespace hedgehop::vision::corridor
