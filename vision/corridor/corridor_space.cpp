#include "vision/corridor/corridor_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/fields/order_statistics.h"

namespace hedgehop::vision::corridor {
namespace {

using PlanPoints = std::vector<Eigen::Vector2d>;

/// Returns the mean distance from the median, measured across a direction, m.
double scatter_m(const PlanPoints& points, double direction_rad, std::vector<double>& across_m) {
  const Eigen::Vector2d right(-std::sin(direction_rad), std::cos(direction_rad));
  across_m.clear();
  for (const Eigen::Vector2d& p : points) across_m.push_back(right.dot(p));
  const double median_m = upper_median(across_m);
  double sum_m = 0.0;
  for (const double m : across_m) sum_m += std::abs(m - median_m);
  return sum_m / static_cast<double>(points.size());
}

/// Returns the minimum lateral distance over all slices; NaN if no slice has enough points.
double min_distance_m(const PlanPoints& points, const GapConfig& config) {
  double nearest_m = std::numeric_limits<double>::quiet_NaN();
  // Slices overlap by half, so that every obstacle lies well inside one.
  for (double from_m = -config.behind_m; from_m < config.ahead_m; from_m += 0.5 * config.slice_m) {
    std::vector<double> asides_m;
    for (const Eigen::Vector2d& p : points) {
      if (p.x() >= from_m && p.x() < from_m + config.slice_m) asides_m.push_back(std::abs(p.y()));
    }
    if (asides_m.size() < static_cast<size_t>(config.least)) continue;
    const auto k = static_cast<size_t>(config.share * static_cast<double>(asides_m.size()));
    nearest_m = std::fmin(nearest_m, kth_smallest(asides_m, k));
  }
  return nearest_m;
}

}  // namespace

Gap gap_ahead(const std::vector<WallPoint>& points, const GapConfig& config) {
  std::vector<Eigen::Vector2d> left, right;
  for (const WallPoint& point : points) {
    if (point.rejection != RejectionReason::none || point.off_travel_rad < config.least_rad) continue;
    (point.p_CP_H.y() < 0.0 ? left : right).push_back(point.p_CP_H.head<2>());
  }
  return {min_distance_m(left, config), min_distance_m(right, config)};
}

double free_time_s(const std::vector<WallPoint>& points, const Eigen::Vector2d& direction_H, double half_width_m,
                   int min_count) {
  const Eigen::Vector2d along = direction_H.normalized();
  const auto enough = static_cast<size_t>(std::max(1, min_count));
  std::vector<double> times_s;
  for (const WallPoint& point : points) {
    const Eigen::Vector2d p = point.p_CP_H.head<2>();
    const double aside_m = along.x() * p.y() - along.y() * p.x();
    const bool met =
        point.rejection == RejectionReason::none && std::abs(aside_m) <= half_width_m && along.dot(p) > 0.0;
    if (met) times_s.push_back(point.contact_s);
  }
  return times_s.size() < enough ? std::numeric_limits<double>::infinity() : kth_smallest(times_s, enough - 1);
}

double wall_direction_rad(const std::vector<WallPoint>& points, double max_rad, int min_count) {
  std::array<PlanPoints, 2> sides;
  for (const WallPoint& point : points) {
    if (point.rejection != RejectionReason::none || point.region == kAhead) continue;
    sides[point.region == kRight].push_back(point.p_CP_H.head<2>());
  }
  const auto enough = static_cast<size_t>(std::max(1, min_count));
  if (sides[0].size() < enough || sides[1].size() < enough) return 0.0;
  std::vector<double> across_m;
  const auto cost_m = [&](double direction_rad) {
    return scatter_m(sides[0], direction_rad, across_m) + scatter_m(sides[1], direction_rad, across_m);
  };
  // Search the whole range first, because a pillar causes another minimum. Then refine around the best direction.
  double best_rad = 0.0, best_m = cost_m(0.0);
  const auto search = [&](double from_rad, double to_rad, double step_rad) {
    for (double direction_rad = from_rad; direction_rad <= to_rad; direction_rad += step_rad) {
      const double m = cost_m(direction_rad);
      if (m < best_m) best_m = m, best_rad = direction_rad;
    }
  };
  constexpr double kCoarseRad = 4.0 * std::numbers::pi / 180.0, kFinestRad = 0.2 * std::numbers::pi / 180.0;
  search(-max_rad, max_rad, kCoarseRad);
  for (double step_rad = 0.5 * kCoarseRad; step_rad > kFinestRad; step_rad *= 0.5) {
    const double about_rad = best_rad;
    search(std::max(-max_rad, about_rad - step_rad), std::min(max_rad, about_rad + step_rad), step_rad);
  }
  return best_rad;
}

std::vector<WallPoint> rotate_points(std::vector<WallPoint> points, double direction_rad) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-direction_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (WallPoint& point : points) point.p_CP_H = turn * point.p_CP_H;
  return points;
}

}  // namespace hedgehop::vision::corridor
