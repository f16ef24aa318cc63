#pragma once

#include <cstring>

#include "scenes/scene.h"

namespace hedgehop::scenes {

inline bool identical(const Mesh& p, const Mesh& q) {
  if (p.indices != q.indices || p.far_indices != q.far_indices || p.vertices.size() != q.vertices.size() ||
      p.chunks.size() != q.chunks.size())
    return false;
  for (size_t i = 0; i < p.vertices.size(); ++i) {
    const Vertex &v = p.vertices[i], &w = q.vertices[i];
    if (v.p_W != w.p_W || v.n_W != w.n_W || v.uv != w.uv || v.texture != w.texture || v.instance != w.instance)
      return false;
  }
  return true;
}

inline bool identical(const std::vector<Solid>& a, const std::vector<Solid>& b) {
  if (a.size() != b.size()) return false;
  for (size_t k = 0; k < a.size(); ++k) {
    if (a[k].name != b[k].name || a[k].shape != b[k].shape || a[k].half_extents_m != b[k].half_extents_m) return false;
    if (a[k].X_WS.matrix() != b[k].X_WS.matrix()) return false;
    if (a[k].polyhedron.corners != b[k].polyhedron.corners || a[k].polyhedron.faces != b[k].polyhedron.faces)
      return false;
  }
  return true;
}

/// Compares bit for bit all data that a flight or an image depends on.
inline bool identical(const Scene& a, const Scene& b) {
  if (a.meshes.size() != b.meshes.size() || a.textures.size() != b.textures.size() ||
      a.movers.size() != b.movers.size() || !identical(a.solids, b.solids)) {
    return false;
  }
  for (size_t k = 0; k < a.meshes.size(); ++k) {
    if (!identical(a.meshes[k], b.meshes[k])) return false;
  }
  for (size_t k = 0; k < a.movers.size(); ++k) {
    if (!identical(a.movers[k].mesh, b.movers[k].mesh) || !identical(a.movers[k].solids, b.movers[k].solids))
      return false;
  }
  const std::vector<cv::Mat> of_a = a.textures.images(), of_b = b.textures.images();
  for (size_t k = 0; k < of_a.size(); ++k) {
    const cv::Mat &p = of_a[k], &q = of_b[k];
    if (p.size() != q.size() || std::memcmp(p.data, q.data, p.total() * p.elemSize()) != 0) return false;
  }
  return true;
}

inline Eigen::AlignedBox3d box_of(const Solid& solid) {
  return {solid.X_WS.translation() - solid.half_extents_m, solid.X_WS.translation() + solid.half_extents_m};
}

}  // namespace hedgehop::scenes
