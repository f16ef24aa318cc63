#include "vision/corridor/corridor_flow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/flow/ray_flow.h"

namespace hedgehop::vision::corridor {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kNever = std::numeric_limits<double>::infinity();

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

/// The k-th smallest, k from 0. Reorders.
double kth(std::vector<double>& values, size_t k) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double narrowest(const std::vector<Eigen::Vector2d>& places, const GapConfig& config) {
  double nearest_m = kUnknown;
  // Slices overlap by half, so that no obstacle is shared out between two.
  for (double from_m = -config.behind_m; from_m < config.ahead_m; from_m += 0.5 * config.slice_m) {
    std::vector<double> asides_m;
    for (const Eigen::Vector2d& p : places) {
      if (p.x() >= from_m && p.x() < from_m + config.slice_m) asides_m.push_back(std::abs(p.y()));
    }
    if (asides_m.size() < static_cast<size_t>(config.least)) continue;
    const auto k = static_cast<size_t>(config.share * static_cast<double>(asides_m.size()));
    nearest_m = std::fmin(nearest_m, kth(asides_m, k));
  }
  return nearest_m;
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

SideDistance side_distance(const std::vector<WallPoint>& points, Region side, int least) {
  std::vector<double> asides_m;
  for (const WallPoint& point : points) {
    if (point.region == side && point.rejection == RejectionReason::none)
      asides_m.push_back(std::abs(point.p_CP_H.y()));
  }
  const size_t count = asides_m.size();
  SideDistance found{kUnknown, static_cast<int>(count)};
  if (found.count < std::max(1, least)) return found;
  found.distance_m = kth(asides_m, count / 2);
  if (count % 2 == 0) {
    found.distance_m =
        0.5 * (found.distance_m +
               *std::max_element(asides_m.begin(), asides_m.begin() + static_cast<std::ptrdiff_t>(count / 2)));
  }
  return found;
}

double middle_offset_m(double left_m, double right_m) { return 0.5 * (right_m - left_m); }

double centering_error(double left_m, double right_m) { return (right_m - left_m) / (right_m + left_m); }

Gap gap_ahead(const std::vector<WallPoint>& points, const GapConfig& config) {
  std::vector<Eigen::Vector2d> left, right;
  for (const WallPoint& point : points) {
    if (point.rejection != RejectionReason::none || point.off_travel_rad < config.least_rad) continue;
    (point.p_CP_H.y() < 0.0 ? left : right).push_back(point.p_CP_H.head<2>());
  }
  return {narrowest(left, config), narrowest(right, config)};
}

double time_to_contact_s(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled,
                         double dt_s) {
  const Eigen::Vector3d way = traveled.normalized();
  const double sin_flow = before.cross(after).norm();
  // D cos(alpha) / v, with D / (v dt) by the law of sines as in distance_m().
  return sin_flow > 0.0 ? dt_s * before.cross(way).norm() * after.dot(way) / sin_flow : kNever;
}

double free_time_s(const std::vector<WallPoint>& points, const Eigen::Vector2d& direction_H, double half_width_m,
                   int least) {
  const Eigen::Vector2d along = direction_H.normalized();
  const auto enough = static_cast<size_t>(std::max(1, least));
  std::vector<double> times_s;
  for (const WallPoint& point : points) {
    const Eigen::Vector2d p = point.p_CP_H.head<2>();
    const double aside_m = along.x() * p.y() - along.y() * p.x();
    const bool met =
        point.rejection == RejectionReason::none && std::abs(aside_m) <= half_width_m && along.dot(p) > 0.0;
    if (met) times_s.push_back(point.contact_s);
  }
  return times_s.size() < enough ? kNever : kth(times_s, enough - 1);
}

}  // namespace hedgehop::vision::corridor
