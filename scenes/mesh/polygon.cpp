#include "scenes/mesh/polygon.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = std::array<uint32_t, 3>;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Returns the corners in a plane in which the polygon is counter-clockwise.
std::vector<Vector2d> projected(std::span<const Vector3d> corners) {
  Vector3d normal = Vector3d::Zero();
  for (size_t i = 0; i < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  Eigen::Index along = 0;
  normal.cwiseAbs().maxCoeff(&along);
  Eigen::Index u = (along + 1) % 3, v = (along + 2) % 3;
  if (normal[along] < 0.0) std::swap(u, v);
  std::vector<Vector2d> flat;
  for (const Vector3d& corner : corners) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

// The corners that are left of a polygon, in a ring.
class Ring {
 public:
  explicit Ring(std::vector<Vector2d> corners)
      : corners_(std::move(corners)), before_(corners_.size()), next_(before_) {
    const auto count = static_cast<uint32_t>(corners_.size());
    for (uint32_t i = 0; i < count; ++i) link(i, (i + 1) % count);
    for (uint32_t i = 0; i < count; ++i) ears_.push_back(is_ear(i));
  }

  // Removes the first ear from corner `at` on, and moves `at` to the corner after it. Without an ear, it removes `at`.
  Triangle cut(uint32_t& at) {
    uint32_t ear = at;
    while (!ears_[ear] && next_[ear] != at) ear = next_[ear];
    if (!ears_[ear]) ear = at;
    const Triangle triangle{before_[ear], ear, next_[ear]};
    link(before_[ear], next_[ear]);
    for (const uint32_t neighbor : {before_[ear], next_[ear]}) ears_[neighbor] = is_ear(neighbor);
    at = next_[ear];
    return triangle;
  }

  Triangle rest(uint32_t at) const { return {before_[at], at, next_[at]}; }

 private:
  void link(uint32_t one, uint32_t other) {
    next_[one] = other;
    before_[other] = one;
  }

  // Whether the triangle of a corner and its neighbors is in the polygon.
  bool is_ear(uint32_t at) const {
    const Vector2d &a = corners_[before_[at]], &b = corners_[at], &c = corners_[next_[at]];
    if (!(cross(b - a, c - b) > 0.0)) return false;
    for (uint32_t i = next_[next_[at]]; i != before_[at]; i = next_[i]) {
      const Vector2d& p = corners_[i];
      if (p == a || p == b || p == c) continue;  // of a bridge to a hole
      if (cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0) return false;
    }
    return true;
  }

  std::vector<Vector2d> corners_;
  std::vector<uint32_t> before_, next_;
  std::vector<bool> ears_;
};

}  // namespace

std::vector<Triangle> triangles_of_polygon(std::span<const Vector3d> corners) {
  std::vector<Triangle> triangles;
  Ring ring(projected(corners));
  uint32_t at = 1;
  for (size_t left = corners.size(); left > 3; --left) triangles.push_back(ring.cut(at));
  triangles.push_back(ring.rest(at));
  return triangles;
}

}  // namespace hedgehop::scenes::mesh
