#include "avoidance/landmark_map/map_route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hedgehop::avoidance::landmark_map {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double point_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * ab).norm();
}

bool crossing(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

double segment_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (crossing(a, b, c, d)) return 0.0;
  return std::min(
      {point_to_segment(a, c, d), point_to_segment(b, c, d), point_to_segment(c, a, b), point_to_segment(d, a, b)});
}

/// Depth of a point inside a hull, and the direction to the nearest edge. Depth <= 0 is outside.
struct Depth {
  double depth_m = -1.0;
  Vector2d out = Vector2d::Zero();
};

Depth depth_inside(const PlanHull& hull, const Vector2d& p) {
  if (hull.size() < 3) return {};
  Depth least{std::numeric_limits<double>::infinity(), Vector2d::Zero()};
  for (size_t k = 0; k < hull.size(); ++k) {
    const Vector2d edge = (hull[(k + 1) % hull.size()] - hull[k]).normalized();
    const double depth_m = cross(edge, p - hull[k]);
    if (depth_m < least.depth_m) least = {depth_m, Vector2d(edge.y(), -edge.x())};
  }
  return least;
}

bool inside(const PlanHull& hull, const Vector2d& p) { return depth_inside(hull, p).depth_m >= 0.0; }

/// Returns whether a straight path keeps the clearance of a hull. If an end is nearer, the path must not come nearer,
/// or deeper inside, than that end. The distance to a convex hull is convex along the path, so its slope at that end
/// decides.
bool keeps_clear(const PlanHull& hull, const Vector2d& a, const Vector2d& b, double clearance_m) {
  const Depth at_a = depth_inside(hull, a), at_b = depth_inside(hull, b);
  if (at_a.depth_m > 0.0 || at_b.depth_m > 0.0) {
    return at_a.depth_m >= at_b.depth_m ? at_a.out.dot(b - a) >= 0.0 : at_b.out.dot(a - b) >= 0.0;
  }
  const double at_ends_m = std::min(distance_to_hull(hull, a, a), distance_to_hull(hull, b, b));
  return distance_to_hull(hull, a, b) >= std::min(clearance_m, at_ends_m) - 1e-9;
}

PlanHull hull_of(const std::vector<Vector2d>& points) {
  std::vector<cv::Point2f> plain, hull;
  for (const Vector2d& p : points) plain.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  cv::convexHull(plain, hull, /*clockwise=*/false);
  PlanHull result;
  for (const cv::Point2f& p : hull) result.emplace_back(p.x, p.y);
  double twice_area = 0.0;
  for (size_t k = 0; k < result.size(); ++k) twice_area += cross(result[k], result[(k + 1) % result.size()]);
  if (twice_area < 0.0) std::ranges::reverse(result);
  return result;
}

}  // namespace

std::vector<PlanHull> plan_hulls(std::span<const Vector2d> points_NE, double link_m) {
  std::vector<PlanHull> hulls;
  std::vector<bool> taken(points_NE.size(), false);
  for (size_t first = 0; first < points_NE.size(); ++first) {
    if (taken[first]) continue;
    taken[first] = true;
    std::vector<Vector2d> group = {points_NE[first]};
    for (size_t member = 0; member < group.size(); ++member) {
      for (size_t i = 0; i < points_NE.size(); ++i) {
        if (taken[i] || (points_NE[i] - group[member]).norm() > link_m) continue;
        taken[i] = true;
        group.push_back(points_NE[i]);
      }
    }
    hulls.push_back(hull_of(group));
  }
  return hulls;
}

double distance_to_hull(const PlanHull& hull, const Vector2d& from_NE, const Vector2d& to_NE) {
  if (inside(hull, from_NE) || inside(hull, to_NE)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < hull.size(); ++k) {
    least = std::min(least, segment_to_segment(from_NE, to_NE, hull[k], hull[(k + 1) % hull.size()]));
  }
  return least;
}

std::optional<std::vector<Vector2d>> path_around(std::span<const PlanHull> hulls, const Vector2d& from_NE,
                                                 const Vector2d& to_NE, double clearance_m) {
  constexpr int kTurns = 8;  // points around a corner; their polygon is outside the clearance
  const double turn_m = 1.02 * clearance_m / std::cos(std::numbers::pi / kTurns);
  const auto clear = [&](const Vector2d& a, const Vector2d& b) {
    return std::ranges::all_of(hulls, [&](const PlanHull& hull) { return keeps_clear(hull, a, b, clearance_m); });
  };
  std::vector<Vector2d> places = {from_NE, to_NE};
  for (const PlanHull& hull : hulls) {
    for (const Vector2d& corner : hull) {
      for (int k = 0; k < kTurns; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kTurns;
        const Vector2d place = corner + turn_m * Vector2d(std::cos(angle), std::sin(angle));
        const bool free = std::ranges::all_of(
            hulls, [&](const PlanHull& other) { return distance_to_hull(other, place, place) >= clearance_m; });
        if (free) places.push_back(place);
      }
    }
  }

  // Dijkstra's search over the points with a free line between them.
  std::vector<double> length(places.size(), std::numeric_limits<double>::infinity());
  std::vector<size_t> before(places.size(), 0);
  std::vector<bool> done(places.size(), false);
  length[0] = 0.0;
  while (true) {
    size_t at = places.size();
    for (size_t i = 0; i < places.size(); ++i) {
      if (!done[i] && std::isfinite(length[i]) && (at == places.size() || length[i] < length[at])) at = i;
    }
    if (at == places.size()) return std::nullopt;
    if (at == 1) break;
    done[at] = true;
    for (size_t i = 0; i < places.size(); ++i) {
      const double reached = length[at] + (places[i] - places[at]).norm();
      if (done[i] || reached >= length[i] || !clear(places[at], places[i])) continue;
      length[i] = reached;
      before[i] = at;
    }
  }
  std::vector<Vector2d> path;
  for (size_t at = 1; at != 0; at = before[at]) path.insert(path.begin(), places[at]);
  return path;
}

}  // namespace hedgehop::avoidance::landmark_map
