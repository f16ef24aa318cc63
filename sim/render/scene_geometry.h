#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// A corner of a triangle. Its brightness is constant, because neither the sun nor the orientation of surfaces changes.
struct DrawnVertex {
  std::array<float, 3> p_W;  ///< m; in M for a moving obstacle
  std::array<float, 2> uv;
  float brightness;  ///< share of albedo
  float layer;       ///< index into Scene::textures
  float label;       ///< as ImageChannel::labels; a float, because vertex attributes are floats
};

/// The triangles of a scene. All meshes, including those of moving obstacles, share one list of vertices and one of
/// indices.
struct SceneGeometry {
  std::vector<DrawnVertex> vertices;
  std::vector<uint32_t> indices;
  /// first_index is an index into the shared list, also for the far detail. The far detail follows the indices of its
  /// chunk.
  std::vector<scenes::Chunk> chunks;
  std::vector<scenes::Chunk> tiles;  ///< flat chunks cut into pairs of triangles, in the order of first_index
  std::vector<std::vector<scenes::Chunk>> mover_chunks;  ///< of each moving obstacle; boxes in M, first_index as above
};

/// Returns the triangles of a scene. Throws std::invalid_argument with the fault for an inconsistent scene.
SceneGeometry make_geometry(const scenes::Scene& scene);

}  // namespace hedgehop::sim
