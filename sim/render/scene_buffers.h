#pragma once

#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// A scene in a context's memory. All meshes, those of the movers too, share one vertex and one index buffer, so that
/// one call draws any of them.
struct SceneBuffers {
  GLuint vertex_array = 0;
  GLuint textures = 0;  ///< GL_TEXTURE_2D_ARRAY, RGBA8
  /// first_index counts in the shared index buffer; so does that of the far detail, which lies behind its chunk's
  /// indices.
  std::vector<scenes::Chunk> chunks;
  std::vector<scenes::Chunk> tiles;  ///< what lies flat, cut into pairs of triangles, in the order of first_index
  std::vector<std::vector<scenes::Chunk>> mover_chunks;  ///< of each mover; boxes in M, first_index as above
};

/// Light falls on each vertex here once, since neither sun nor surfaces move.
/// Throws std::invalid_argument, naming what is wrong, for a scene that contradicts itself.
SceneBuffers upload(const GlFunctions& gl, const scenes::Scene& scene);

}  // namespace hedgehop::sim
