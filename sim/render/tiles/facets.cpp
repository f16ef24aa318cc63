#include "sim/render/tiles/facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sim/render/visible_chunks.h"

namespace hedgehop::sim::tiles {

namespace {

using Triangle = std::array<const DrawnVertex*, 3>;

Eigen::Vector3d position(const DrawnVertex& vertex) {
  return Eigen::Map<const Eigen::Vector3f>(vertex.p_W.data()).cast<double>();
}

bool equal(const DrawnVertex& a, const DrawnVertex& b) {
  return a.p_W == b.p_W && a.uv == b.uv && a.brightness == b.brightness && a.layer == b.layer;
}

/// The plane of a triangle, and gradients of values that are affine over it.
class TrianglePlane {
 public:
  explicit TrianglePlane(const Triangle& triangle)
      : origin_(position(*triangle[0])), a_(position(*triangle[1]) - origin_), b_(position(*triangle[2]) - origin_) {
    normal_ = a_.cross(b_);
  }

  bool has_area() const { return normal_.squaredNorm() > 0.0; }
  const Eigen::Vector3d& normal() const { return normal_; }

  /// @param values  at the corners of the triangle.
  Eigen::Vector3d gradient(const std::array<double, 3>& values) const {
    const Eigen::Vector3d across_b = b_.cross(normal_), across_a = normal_.cross(a_);
    return ((values[1] - values[0]) * across_b + (values[2] - values[0]) * across_a) / normal_.squaredNorm();
  }

  double distance_m(const Eigen::Vector3d& p) const { return std::abs(normal_.dot(p - origin_)) / normal_.norm(); }
  double size_m() const { return std::max(a_.norm(), b_.norm()); }

 private:
  Eigen::Vector3d origin_, a_, b_, normal_;
};

std::array<double, 3> values(const Triangle& triangle, double (*value)(const DrawnVertex&)) {
  return {value(*triangle[0]), value(*triangle[1]), value(*triangle[2])};
}
double u(const DrawnVertex& vertex) { return static_cast<double>(vertex.uv[0]); }
double v(const DrawnVertex& vertex) { return static_cast<double>(vertex.uv[1]); }
double brightness(const DrawnVertex& vertex) { return static_cast<double>(vertex.brightness); }

using CornerList = std::array<const DrawnVertex*, 4>;

/// Returns whether the fourth corner fits the plane, texture and brightness of the first three, and the polygon is
/// convex.
bool is_facet(const CornerList& corners) {
  const Triangle half{corners[0], corners[1], corners[2]};
  const TrianglePlane plane(half);
  const DrawnVertex& last = *corners[3];
  constexpr double kMaxDistance = 2e-6, kMaxDifference = 1e-4;
  if (!plane.has_area() || plane.distance_m(position(last)) > kMaxDistance * plane.size_m()) return false;
  for (double (*value)(const DrawnVertex&) : {u, v, brightness}) {
    const double found =
        value(*corners[0]) + plane.gradient(values(half, value)).dot(position(last) - position(*corners[0]));
    if (std::abs(found - value(last)) > kMaxDifference) return false;
  }
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d before = position(*corners[(i + 1) % 4]) - position(*corners[i]);
    const Eigen::Vector3d after = position(*corners[(i + 2) % 4]) - position(*corners[(i + 1) % 4]);
    if (!(before.cross(after).dot(plane.normal()) > 0.0)) return false;
  }
  return true;
}

/// Returns the corners of two triangles that share an edge and form one facet; none otherwise.
std::optional<CornerList> merged(const Triangle& a, const Triangle& b) {
  if (a[0]->layer != b[0]->layer || a[0]->label != b[0]->label) return std::nullopt;
  for (size_t i = 0; i < 3; ++i) {
    const DrawnVertex &from = *a[i], &to = *a[(i + 1) % 3];
    for (size_t k = 0; k < 3; ++k) {
      if (!equal(*b[k], to) || !equal(*b[(k + 1) % 3], from)) continue;
      const CornerList corners{&from, b[(k + 2) % 3], &to, a[(i + 2) % 3]};
      if (is_facet(corners)) return corners;
    }
  }
  return std::nullopt;
}

void add(const CornerList& corners, Facets& facets) {
  const Triangle half{corners[0], corners[1], corners[2]};
  const TrianglePlane plane(half);
  if (!plane.has_area()) return;
  FacetShape& shape = facets.shapes.emplace_back();
  for (size_t i = 0; i < 4; ++i) {
    shape.x_m[i] = corners[i]->p_W[0];
    shape.y_m[i] = corners[i]->p_W[1];
    shape.z_m[i] = corners[i]->p_W[2];
  }
  const Eigen::Vector3d n = plane.normal().normalized();
  facets.n_x.push_back(static_cast<float>(n.x()));
  facets.n_y.push_back(static_cast<float>(n.y()));
  facets.n_z.push_back(static_cast<float>(n.z()));
  facets.offset_m.push_back(static_cast<float>(n.dot(position(*corners[0]))));
  FacetAttributes& cover = facets.attributes.emplace_back();
  float* number = cover.values;
  for (double (*value)(const DrawnVertex&) : {u, v, brightness}) {
    const Eigen::Vector3d gradient = plane.gradient(values(half, value));
    number[0] = static_cast<float>(value(*corners[0]));
    for (int i = 0; i < 3; ++i) number[3 + 3 * i] = static_cast<float>(gradient[i]);
    ++number;
  }
  cover.texture = static_cast<uint32_t>(corners[0]->layer);
  cover.label = static_cast<int32_t>(corners[0]->label);
  cover.evenly_lit =
      brightness(*corners[0]) == brightness(*corners[1]) && brightness(*corners[0]) == brightness(*corners[2]);
}

void add_stretch(const SceneGeometry& geometry, uint32_t first_index, uint32_t index_count, bool in_pairs,
                 Facets& facets) {
  const auto triangle = [&](uint32_t index) -> Triangle {
    const auto corner = [&](uint32_t i) { return &geometry.vertices[geometry.indices[index + i]]; };
    return {corner(0), corner(1), corner(2)};
  };
  const uint32_t end = first_index + index_count;
  for (uint32_t index = first_index; index < end; index += 3) {
    const Triangle a = triangle(index);
    facets.of_triangle[index / 3] = static_cast<uint32_t>(facets.shapes.size());
    const bool may_pair = index + 3 < end && (!in_pairs || (index - first_index) % 6 == 0);
    if (const auto both = may_pair ? merged(a, triangle(index + 3)) : std::nullopt) {
      add(*both, facets);
      index += 3;
      facets.of_triangle[index / 3] = static_cast<uint32_t>(facets.shapes.size());
    } else {
      add({a[0], a[1], a[2], a[2]}, facets);
    }
  }
}

}  // namespace

Facets make_facets(const SceneGeometry& geometry) {
  Facets facets;
  facets.of_triangle.assign(geometry.indices.size() / 3 + 1, 0);
  const auto add_chunk = [&](const scenes::Chunk& chunk) {
    add_stretch(geometry, chunk.first_index, chunk.index_count, lies_flat(chunk), facets);
    add_stretch(geometry, chunk.far.first_index, chunk.far.index_count, false, facets);
  };
  for (const scenes::Chunk& chunk : geometry.chunks) add_chunk(chunk);
  for (const std::vector<scenes::Chunk>& mover : geometry.mover_chunks) {
    for (const scenes::Chunk& chunk : mover) add_chunk(chunk);
  }
  facets.of_triangle.back() = static_cast<uint32_t>(facets.shapes.size());
  constexpr size_t kReadableElements = 7;  // see FacetPlanes
  for (auto* numbers : {&facets.n_x, &facets.n_y, &facets.n_z, &facets.offset_m}) {
    numbers->resize(numbers->size() + kReadableElements);
  }
  return facets;
}

}  // namespace hedgehop::sim::tiles
