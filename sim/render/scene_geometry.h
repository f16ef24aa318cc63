#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// A corner of a triangle, lit once, since neither sun nor surfaces move.
struct DrawnVertex {
  std::array<float, 3> p_W;  ///< m; of a mover in M
  std::array<float, 2> uv;
  float brightness;  ///< share of albedo
  float layer;       ///< index into Scene::textures
};

/// A scene's triangles. All meshes, those of the movers too, share one list of vertices and one of indices.
struct SceneGeometry {
  std::vector<DrawnVertex> vertices;
  std::vector<uint32_t> indices;
  /// first_index counts in the shared list of indices; so does that of the far detail, which lies behind its chunk's
  /// indices.
  std::vector<scenes::Chunk> chunks;
  std::vector<scenes::Chunk> tiles;  ///< what lies flat, cut into pairs of triangles, in the order of first_index
  std::vector<std::vector<scenes::Chunk>> mover_chunks;  ///< of each mover; boxes in M, first_index as above
};

/// Throws std::invalid_argument, naming what is wrong, for a scene that contradicts itself.
SceneGeometry make_geometry(const scenes::Scene& scene);

}  // namespace hedgehop::sim
