#include "scenes/mesh/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Returns whether all other points lie behind the plane of a face, seen from outside.
bool all_behind(const std::vector<Vector3d>& points, const Face& face) {
  const Vector3d a = points[face[0]], n = (points[face[1]] - a).cross(points[face[2]] - a);
  for (uint32_t i = 0; i < points.size(); ++i) {
    if (i != face[0] && i != face[1] && i != face[2] && n.dot(points[i] - a) >= 0.0) return false;
  }
  return true;
}

Polyhedron cut_in_four(const Polyhedron& coarse) {
  Polyhedron fine;
  fine.corners = coarse.corners;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(fine.corners.size()));
    if (is_new) fine.corners.push_back((coarse.corners[a] + coarse.corners[b]).normalized());
    return at->second;
  };
  for (const auto& [a, b, c] : coarse.faces) {
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Face& face : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}})
      fine.faces.push_back(face);
  }
  return fine;
}

}  // namespace

Polyhedron moved(const Eigen::Affine3d& map, const Polyhedron& polyhedron) {
  Polyhedron result = polyhedron;
  for (Vector3d& corner : result.corners) corner = map * corner;
  return result;
}

Polyhedron ball(int cuts) {
  const double g = std::numbers::phi;
  std::vector<Vector3d> corners;
  for (const double one : {-1.0, 1.0}) {
    for (const double golden : {-g, g}) {
      corners.push_back(Vector3d(0.0, one, golden).normalized());
      corners.push_back(Vector3d(one, golden, 0.0).normalized());
      corners.push_back(Vector3d(golden, 0.0, one).normalized());
    }
  }
  Polyhedron result = convex_hull(corners);
  for (int k = 0; k < cuts; ++k) result = cut_in_four(result);
  return result;
}

Polyhedron convex_hull(const std::vector<Eigen::Vector3d>& points) {
  const auto count = static_cast<uint32_t>(points.size());
  Polyhedron hull;
  std::vector<uint32_t> renumbered(count, kNone);
  const auto keep = [&](const Face& face) {
    Face kept{};
    for (size_t k = 0; k < 3; ++k) {
      uint32_t& index = renumbered[face[k]];
      if (index == kNone) {
        index = static_cast<uint32_t>(hull.corners.size());
        hull.corners.push_back(points[face[k]]);
      }
      kept[k] = index;
    }
    hull.faces.push_back(kept);
  };
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      for (uint32_t k = j + 1; k < count; ++k) {
        if (all_behind(points, {i, j, k})) keep({i, j, k});
        if (all_behind(points, {i, k, j})) keep({i, k, j});
      }
    }
  }
  return hull;
}

Vector3d spiral_direction(int k, int count, double first_rad) {
  const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double z = 1.0 - (2.0 * k + 1.0) / count, across = std::sqrt(1.0 - z * z);
  const double turn_rad = first_rad + golden_angle_rad * k;
  return {across * std::cos(turn_rad), across * std::sin(turn_rad), z};
}

Polyhedron convex_lump(int points, double roughness, Random& random) {
  const double first_rad = uniform(random, 0.0, 2.0 * std::numbers::pi);
  std::vector<Vector3d> corners;
  for (int k = 0; k < points; ++k) {
    corners.push_back(uniform(random, 1.0 - roughness, 1.0) * spiral_direction(k, points, first_rad));
  }
  return convex_hull(corners);
}

}  // namespace hedgehop::scenes::mesh
