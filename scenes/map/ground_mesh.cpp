#include "scenes/map/ground_mesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "scenes/mesh/bodies.h"
#include "scenes/terrain/coarse_block.h"
#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using GroundTriangle = std::array<Vector3d, 3>;

double cross_NE(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Keeps the part of a convex polygon to the left of a line seen from above.
void keep_left(const Vector2d& from_NE, const Vector2d& to_NE, std::vector<Vector2d>& polygon) {
  std::vector<Vector2d> kept;
  const auto left_of = [&](const Vector2d& p) { return cross_NE(p - from_NE, to_NE - from_NE); };  // axes: north, east
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &p = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double here = left_of(p), there = left_of(next);
    if (here >= 0.0) kept.push_back(p);
    if ((here >= 0.0) != (there >= 0.0)) kept.push_back(p + here / (here - there) * (next - p));
  }
  polygon = std::move(kept);
}

/// Returns the shares of the corners of a triangle of the plan in a point.
Vector3d shares(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
  Eigen::Matrix2d sides;
  sides << b - a, c - a;
  const Vector2d share = sides.inverse() * (p - a);
  return {1.0 - share.sum(), share.x(), share.y()};
}

/// Streets by their bounds in the plan.
class StreetIndex {
 public:
  explicit StreetIndex(const std::vector<StreetTriangle>& streets) : streets_(streets) {
    for (const StreetTriangle& street : streets) {
      AlignedBox2d& box = boxes_.emplace_back();
      for (const Vector2d& p : street.p_NE) box.extend(p);
    }
  }

  /// Adds the streets over triangles of the ground to the current chunk.
  void add(std::span<const GroundTriangle> ground, mesh::MeshBuilder& mesh) const {
    AlignedBox2d all;
    for (const GroundTriangle& triangle : ground) all.extend(box_of(triangle));
    std::vector<size_t> near;
    for (size_t k = 0; k < boxes_.size(); ++k) {
      if (boxes_[k].intersects(all)) near.push_back(k);
    }
    std::vector<Vertex> vertices;
    std::vector<std::array<uint32_t, 3>> faces;
    for (const GroundTriangle& triangle : ground) {
      const AlignedBox2d box = box_of(triangle);
      for (const size_t k : near) {
        if (boxes_[k].intersects(box)) drape(streets_[k], triangle, vertices, faces);
      }
    }
    mesh.add(vertices, faces);
  }

 private:
  static AlignedBox2d box_of(const GroundTriangle& triangle) {
    AlignedBox2d box;
    for (const Vector3d& p_W : triangle) box.extend(p_W.head<2>());
    return box;
  }

  const std::vector<StreetTriangle>& streets_;
  std::vector<AlignedBox2d> boxes_;
};

/// Adds streets on the plane at altitude 0, in chunks of neighboring triangles.
void add_level_streets(const std::vector<StreetTriangle>& streets, mesh::MeshBuilder& mesh) {
  constexpr double kChunkM = 128.0;
  std::map<std::pair<int, int>, std::vector<const StreetTriangle*>> chunks;
  for (const StreetTriangle& street : streets) {
    const Vector2d middle = (street.p_NE[0] + street.p_NE[2]) / (2.0 * kChunkM);
    chunks[{static_cast<int>(std::floor(middle.x())), static_cast<int>(std::floor(middle.y()))}].push_back(&street);
  }
  for (const auto& [place, members] : chunks) {
    mesh.begin_chunk(false);
    for (const StreetTriangle* street : members) {
      std::array<Vertex, 3> corners;
      for (size_t k = 0; k < 3; ++k) {
        corners[k].p_W = Vector3d(street->p_NE[k].x(), street->p_NE[k].y(), -street->lift_m).cast<float>();
        corners[k].uv = street->uv[k].cast<float>();
        corners[k].texture = street->texture;
      }
      mesh.add(corners, std::array<std::array<uint32_t, 3>, 1>{{{0, 1, 2}}});
    }
  }
}

std::vector<GroundTriangle> in_W(const terrain::SurfaceGrid& grid, std::span<const terrain::GridTriangle> triangles) {
  std::vector<GroundTriangle> result;
  for (const auto& [a, b, c] : triangles)
    result.push_back({grid.p_W(a.row, a.column), grid.p_W(b.row, b.column), grid.p_W(c.row, c.column)});
  return result;
}

void add_terrain(const terrain::SurfaceGrid& grid, const std::vector<StreetTriangle>& streets, uint32_t grass,
                 mesh::MeshBuilder& mesh, std::vector<Solid>& solids) {
  constexpr int kCellsPerBlock = 8;
  constexpr double kMinLostM = 1.5;  // as for buildings: heights in depth images from nearby are exact
  const StreetIndex index(streets);
  const uint32_t ground = mesh.begin_instance("terrain", SemanticClass::ground),
                 road = mesh.begin_instance("road", SemanticClass::road);
  const auto add = [&](const std::vector<terrain::GridTriangle>& triangles) {
    mesh.resume_instance(ground);
    terrain::add_triangles(grid, triangles, grass, mesh);
    mesh.resume_instance(road);
    index.add(in_W(grid, triangles), mesh);
  };
  for (const terrain::GridBlock& block : terrain::blocks_of(grid, kCellsPerBlock)) {
    const std::vector<terrain::GridTriangle> triangles = terrain::triangles_of(grid, block);
    if (triangles.empty()) continue;
    mesh.begin_chunk(false);
    add(triangles);
    solids.push_back(terrain::solid_of(grid, triangles));
    const terrain::CoarseBlock coarse = terrain::coarse_block(grid, block);
    if (coarse.triangles.empty()) continue;
    const size_t first_far = mesh.index_count();
    add(coarse.triangles);
    mesh.move_to_far(first_far, std::max(2.0 * coarse.error_m, kMinLostM));
  }
}

}  // namespace

void drape(const StreetTriangle& street, const GroundTriangle& ground_W, std::vector<Vertex>& vertices,
           std::vector<std::array<uint32_t, 3>>& faces) {
  const std::array<Vector2d, 3> ground_NE{ground_W[0].head<2>(), ground_W[1].head<2>(), ground_W[2].head<2>()};
  std::vector<Vector2d> polygon(street.p_NE.begin(), street.p_NE.end());
  for (size_t k = 0; k < 3 && polygon.size() >= 3; ++k) keep_left(ground_NE[k], ground_NE[(k + 1) % 3], polygon);
  double twice_m2 = 0.0;
  for (size_t i = 2; i < polygon.size(); ++i)
    twice_m2 += std::abs(cross_NE(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  constexpr double kMinTwiceM2 = 1e-6;
  if (twice_m2 < kMinTwiceM2) return;
  const Vector3d n_W = (ground_W[1] - ground_W[0]).cross(ground_W[2] - ground_W[0]).normalized();
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const Vector2d& p : polygon) {
    const Vector3d of_ground = shares(ground_NE[0], ground_NE[1], ground_NE[2], p),
                   of_street = shares(street.p_NE[0], street.p_NE[1], street.p_NE[2], p);
    double down_m = -street.lift_m;
    Vector2d uv = Vector2d::Zero();
    for (size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      down_m += of_ground[axis] * ground_W[k].z();
      uv += of_street[axis] * street.uv[k];
    }
    Vertex& vertex = vertices.emplace_back();
    vertex.p_W = Vector3d(p.x(), p.y(), down_m).cast<float>();
    vertex.n_W = n_W.cast<float>();
    vertex.uv = uv.cast<float>();
    vertex.texture = street.texture;
  }
  for (uint32_t i = 2; i < polygon.size(); ++i) faces.push_back({first, first + i - 1, first + i});
}

void add_ground_mesh(const Ground& ground, const std::vector<StreetTriangle>& streets, double half_m, uint32_t grass,
                     mesh::MeshBuilder& mesh, std::vector<Solid>& solids) {
  if (ground.terrain()) return add_terrain(*ground.terrain(), streets, grass, mesh, solids);
  mesh::add_ground(half_m, {grass, textures::kGrassTileM}, mesh);
  if (streets.empty()) return;
  mesh.begin_instance("road", SemanticClass::road);
  add_level_streets(streets, mesh);
}

}  // namespace hedgehop::scenes::map
