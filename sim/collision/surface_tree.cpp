#include "sim/collision/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hedgehop::sim {
namespace {

using Eigen::AlignedBox3d;
using Eigen::AlignedBox3f;
using Eigen::Vector3d;
using scenes::mesh::Polyhedron;

/// Returns a box in single precision that contains the corners of a triangle.
AlignedBox3f box_of(const Polyhedron& polyhedron, const std::array<uint32_t, 3>& face, const Eigen::Isometry3d& X_WS) {
  constexpr double kRounding = 2e-7;  // of single precision, relative to the coordinates
  AlignedBox3d box;
  for (const uint32_t corner : face) box.extend(X_WS * polyhedron.corners[corner]);
  const Vector3d margin = kRounding * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  return {(box.min() - margin).cast<float>(), (box.max() + margin).cast<float>()};
}

/// Searches the tree for triangles near a box, in the form that Eigen's BVMinimize() asks for.
struct NearSearch {
  using Scalar = double;
  const std::function<double(const AlignedBox3d& box_W)>& bound_m;
  const std::function<double()>& reach_m;
  const std::function<void(size_t id)>& visit;

  double minimumOnVolume(const AlignedBox3f& volume) const {
    const double distance_m = bound_m(volume.cast<double>());
    // Slightly less, so that equally near triangles are all visited.
    constexpr double kEqualM = 1e-12;
    return distance_m <= reach_m() ? distance_m - kEqualM : kNever;
  }
  double minimumOnObject(uint32_t id) const {
    visit(id);
    return std::max(reach_m(), 0.0);
  }
  static constexpr double kNever = std::numeric_limits<double>::max();
};

/// Searches for triangles along a segment, in the form that Eigen's BVIntersect() asks for.
struct SegmentSearch {
  Vector3d from_W, along_W;
  const std::function<AlignedBox3f(size_t id)>& box_of_triangle;
  const std::function<void(size_t id)>& visit;

  bool intersectVolume(const AlignedBox3f& volume) const {
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = static_cast<double>(volume.min()[axis]), high = static_cast<double>(volume.max()[axis]);
      if (along_W[axis] == 0.0) {
        if (from_W[axis] < low || from_W[axis] > high) return false;
        continue;
      }
      const double one = (low - from_W[axis]) / along_W[axis], other = (high - from_W[axis]) / along_W[axis];
      enter = std::max(enter, std::min(one, other));
      leave = std::min(leave, std::max(one, other));
    }
    constexpr double kRounding = 1e-12;  // of the quotients
    return enter <= leave + kRounding;
  }
  bool intersectObject(uint32_t id) const {
    if (intersectVolume(box_of_triangle(id))) visit(id);
    return false;  // go on
  }
};

}  // namespace

void SurfaceTree::add(const scenes::Solid& solid, size_t first_id) {
  surfaces_.push_back({solid.polyhedron, solid.X_WS, first_id});
}

void SurfaceTree::build() {
  std::vector<uint32_t> ids;
  std::vector<AlignedBox3f> boxes;
  size_t count = 0;
  for (const Surface& surface : surfaces_) count += surface.polyhedron.faces.size();
  ids.reserve(count);
  boxes.reserve(count);
  for (const Surface& surface : surfaces_) {
    if (surface.first_id + surface.polyhedron.faces.size() > std::numeric_limits<uint32_t>::max()) {
      throw std::invalid_argument("the scene has too many triangles");
    }
    for (size_t k = 0; k < surface.polyhedron.faces.size(); ++k) {
      ids.push_back(static_cast<uint32_t>(surface.first_id + k));
      boxes.push_back(box_of(surface.polyhedron, surface.polyhedron.faces[k], surface.X_WS));
    }
  }
  tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
}

bool SurfaceTree::has(size_t id) const {
  if (surfaces_.empty() || id < surfaces_.front().first_id) return false;
  const Surface& surface = surface_of(id);
  return id < surface.first_id + surface.polyhedron.faces.size();
}

const SurfaceTree::Surface& SurfaceTree::surface_of(size_t id) const {
  return *std::prev(std::ranges::upper_bound(surfaces_, id, {}, &Surface::first_id));
}

AlignedBox3f SurfaceTree::box_of_triangle(size_t id) const {
  const Surface& surface = surface_of(id);
  return box_of(surface.polyhedron, surface.polyhedron.faces[id - surface.first_id], surface.X_WS);
}

void SurfaceTree::visit_one(size_t id, const Visit& visit) const {
  const Surface& surface = surface_of(id);
  const auto& [a, b, c] = surface.polyhedron.faces[id - surface.first_id];
  const std::vector<Vector3d>& corners = surface.polyhedron.corners;
  const Vector3d center = (corners[a] + corners[b] + corners[c]) / 3.0;
  const TriangleBody triangle({{corners[a] - center, corners[b] - center, corners[c] - center}, {{0, 1, 2}}},
                              surface.X_WS * Eigen::Translation3d(center));
  visit(id, triangle.placed);
}

void SurfaceTree::visit_near(const std::function<double(const AlignedBox3d& box_W)>& distance_m,
                             const std::function<double()>& reach_m, const Visit& visit) const {
  if (surfaces_.empty()) return;
  // The tree tests the boxes of its nodes only. Most triangles of a node are farther away.
  const std::function<void(size_t)> visit_id = [&](size_t id) {
    if (distance_m(box_of_triangle(id).cast<double>()) <= reach_m()) visit_one(id, visit);
  };
  NearSearch search{distance_m, reach_m, visit_id};
  Eigen::BVMinimize(tree_, search);
}

void SurfaceTree::visit_along(const Vector3d& from_W, const Vector3d& to_W, const Visit& visit) const {
  if (surfaces_.empty()) return;
  const std::function<void(size_t)> visit_id = [&](size_t id) { visit_one(id, visit); };
  const std::function<AlignedBox3f(size_t)> box = [this](size_t id) { return box_of_triangle(id); };
  SegmentSearch search{from_W, to_W - from_W, box, visit_id};
  Eigen::BVIntersect(tree_, search);
}

}  // namespace hedgehop::sim
