#pragma once

#include <cstring>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// Bit for bit, everything that a flight or a picture depends on.
inline bool identical(const Scene& a, const Scene& b) {
  if (a.meshes.size() != b.meshes.size() || a.textures.size() != b.textures.size() ||
      a.solids.size() != b.solids.size()) {
    return false;
  }
  for (size_t k = 0; k < a.meshes.size(); ++k) {
    const Mesh &p = a.meshes[k], &q = b.meshes[k];
    if (p.indices != q.indices || p.vertices.size() != q.vertices.size() || p.chunks.size() != q.chunks.size())
      return false;
    for (size_t i = 0; i < p.vertices.size(); ++i) {
      const Vertex &v = p.vertices[i], &w = q.vertices[i];
      if (v.p_W != w.p_W || v.n_W != w.n_W || v.uv != w.uv || v.texture != w.texture) return false;
    }
  }
  for (size_t k = 0; k < a.textures.size(); ++k) {
    const cv::Mat &p = a.textures[k], &q = b.textures[k];
    if (p.size() != q.size() || std::memcmp(p.data, q.data, p.total() * p.elemSize()) != 0) return false;
  }
  for (size_t k = 0; k < a.solids.size(); ++k) {
    if (a.solids[k].half_extents_m != b.solids[k].half_extents_m) return false;
    if (a.solids[k].X_WS.matrix() != b.solids[k].X_WS.matrix()) return false;
  }
  return true;
}

inline Eigen::AlignedBox3d box_of(const Solid& solid) {
  return {solid.X_WS.translation() - solid.half_extents_m, solid.X_WS.translation() + solid.half_extents_m};
}

}  // namespace hedgehop::scenes
