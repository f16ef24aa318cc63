#include "sim/falsify/box_constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "dynamics/hull.h"
#include "sim/config/numbers.h"
#include "sim/fields/quantities.h"
#include "sim/verdict/shortest_path.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector2d;
using scenes::BoxConfig;

Vector2d along(const BoxConfig& box) { return {std::cos(box.heading_rad), std::sin(box.heading_rad)}; }
Vector2d across(const BoxConfig& box) { return {-std::sin(box.heading_rad), std::cos(box.heading_rad)}; }
Vector2d middle(const BoxConfig& box) { return {box.north_m, box.east_m}; }

/// Returns half the extent of a box along a unit vector.
double half_extent_m(const BoxConfig& box, const Vector2d& direction) {
  return 0.5 *
         (box.length_m * std::abs(along(box).dot(direction)) + box.width_m * std::abs(across(box).dot(direction)));
}

double outside_m(const FalsifyBoxes& range, const BoxConfig& box) {
  double sum_m = 0.0;
  for (const Vector2d& corner : box.corners_NE_m()) {
    sum_m += std::max({0.0, range.north_m[0] - corner.x(), corner.x() - range.north_m[1]});
    sum_m += std::max({0.0, range.east_m[0] - corner.y(), corner.y() - range.east_m[1]});
  }
  return sum_m;
}

/// Returns the start, the waypoints of the route, and the goal.
std::vector<Vector2d> places_of(const Scenario& scenario) {
  std::vector<Vector2d> places{scenario.start.p_WB().head<2>()};
  for (const GoalConfig& place : scenario.route) places.emplace_back(place.p_WG().head<2>());
  if (scenario.goal) places.emplace_back(scenario.goal->p_WG().head<2>());
  return places;
}

/// Returns the distance of the nearest box from the straight lines of the route, m, in steps of half a meter.
double off_route_m(const Scenario& scenario, const std::vector<BoxConfig>& boxes) {
  constexpr double kStepM = 0.5;
  const std::vector<Vector2d> places = places_of(scenario);
  double min_m = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < places.size(); ++i) {
    const Vector2d leg = places[i] - places[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(leg.norm() / kStepM)));
    for (int k = 0; k <= steps; ++k) {
      for (const BoxConfig& box : boxes)
        min_m = std::min(min_m, plan_distance_m(box, places[i - 1] + leg * (static_cast<double>(k) / steps)));
    }
  }
  return min_m;
}

/// Returns whether a collision-free path leads from the start through the waypoints of the route to the goal.
bool way_exists(const Scenario& scenario, const std::vector<BoxConfig>& boxes) {
  constexpr double kClearM = 0.5, kCellM = 0.5, kMarginM = 20.0;
  if (!scenario.goal) return true;
  const double radius_m = dynamics::radius_m(dynamics::hull(scenario.vehicle)) + kClearM;
  const auto clearance_m = [&](const Vector2d& p_NE_m) {
    double min_m = std::numeric_limits<double>::infinity();
    for (const BoxConfig& box : boxes) min_m = std::min(min_m, plan_distance_m(box, p_NE_m) - radius_m);
    return min_m;
  };
  const std::vector<Vector2d> places = places_of(scenario);
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& place : places) bounds.extend(place);
  for (const BoxConfig& box : boxes) {
    for (const Vector2d& corner : box.corners_NE_m()) bounds.extend(corner);
  }
  bounds = {bounds.min().array() - kMarginM, bounds.max().array() + kMarginM};
  for (size_t i = 1; i < places.size(); ++i) {
    if (!shortest_path_m(places[i - 1], {places[i], 0.0}, bounds, kCellM, clearance_m)) return false;
  }
  return true;
}

}  // namespace

double overlap_m(const BoxConfig& a, const BoxConfig& b) {
  double min_m = std::numeric_limits<double>::infinity();
  for (const Vector2d& axis : {along(a), across(a), along(b), across(b)}) {
    const double apart_m = std::abs(axis.dot(middle(a) - middle(b)));
    min_m = std::min(min_m, half_extent_m(a, axis) + half_extent_m(b, axis) - apart_m);
  }
  return min_m;
}

double common_area_m2(const BoxConfig& a, const BoxConfig& b) {
  std::vector<Vector2d> polygon = a.corners_NE_m();
  const auto clip = [&](const Vector2d& normal, double half_m) {
    const std::vector<Vector2d> whole = std::exchange(polygon, {});
    const auto beyond_m = [&](const Vector2d& p) { return normal.dot(p - middle(b)) - half_m; };
    for (size_t i = 0; i < whole.size(); ++i) {
      const Vector2d &from = whole[i], &to = whole[(i + 1) % whole.size()];
      const double from_m = beyond_m(from), to_m = beyond_m(to);
      if (from_m <= 0.0) polygon.push_back(from);
      if ((from_m < 0.0 && to_m > 0.0) || (from_m > 0.0 && to_m < 0.0))
        polygon.emplace_back(from + (to - from) * (from_m / (from_m - to_m)));
    }
  };
  for (const double sign : {1.0, -1.0}) {
    clip(sign * along(b), 0.5 * b.length_m);
    clip(sign * across(b), 0.5 * b.width_m);
  }
  double twice_m2 = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice_m2 += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * std::abs(twice_m2);
}

double plan_distance_m(const BoxConfig& box, const Vector2d& p_NE_m) {
  const Vector2d p = p_NE_m - middle(box);
  const double along_m = std::max(0.0, std::abs(p.dot(along(box))) - 0.5 * box.length_m);
  const double across_m = std::max(0.0, std::abs(p.dot(across(box))) - 0.5 * box.width_m);
  return std::hypot(along_m, across_m);
}

std::vector<BoxConfig> boxes_at(const FalsifySearch& search, const std::vector<std::string>& values) {
  std::vector<BoxConfig> boxes = std::visit([](const auto& scene) { return scene.added.boxes; }, search.scenario.scene);
  for (size_t i = 0; i < values.size(); ++i) {
    const double value = parse_number(values[i], false).member;
    for (size_t k = 0; k < boxes.size(); ++k) {
      const auto set = [&](const char* key, double& member, double factor = 1.0) {
        if (search.sweep.parameters[i].path == box_path(k, key)) member = factor * value;
      };
      set("north", boxes[k].north_m);
      set("east", boxes[k].east_m);
      set("length", boxes[k].length_m);
      set("width", boxes[k].width_m);
      set("height", boxes[k].height_m);
      set("heading", boxes[k].heading_rad, kRadPerDeg);
    }
  }
  return boxes;
}

double violation(const FalsifySearch& search, const std::vector<BoxConfig>& boxes) {
  double sum = 0.0;
  const auto requires_constraint = [&](FalsifyConstraint constraint) {
    return std::ranges::find(search.config.constraints, constraint) != search.config.constraints.end();
  };
  if (requires_constraint(FalsifyConstraint::boxes_inside)) {
    for (const BoxConfig& box : boxes) sum += outside_m(*search.config.boxes, box);
  }
  if (requires_constraint(FalsifyConstraint::boxes_apart)) {
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (size_t k = 0; k < i; ++k) sum += std::max(0.0, overlap_m(boxes[i], boxes[k]));
    }
  }
  if (requires_constraint(FalsifyConstraint::box_on_route)) sum += off_route_m(search.scenario, boxes);
  if (sum == 0.0 && requires_constraint(FalsifyConstraint::way_exists) && !way_exists(search.scenario, boxes))
    sum = 1.0;
  return sum;
}

}  // namespace hedgehop::sim
