#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/chunk_tree.h"
#include "sim/render/horizon.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Finds what a view can see of a scene's chunks. Reuses its memory from view to view.
class VisibleChunks {
 public:
  explicit VisibleChunks(std::vector<scenes::Chunk> chunks);

  /// Chunks to draw, in the order in which they hide each other best: what stands up from near to far in plan, then
  /// what lies flat (ground, ceiling), which seldom hides anything. The order of two chunks does not depend on the
  /// culling.
  std::span<const scenes::Chunk> find(const CameraView& view, Culling culling);

 private:
  struct Ranked {
    double distance_m = 0.0;
    uint32_t index = 0;
  };
  struct Farther;

  std::vector<scenes::Chunk> chunks_;
  ChunkTree tree_;
  Horizon horizon_;
  std::vector<Ranked> queue_;  ///< heap of nodes, nearest on top
  std::vector<scenes::Chunk> upright_, flat_;
};

}  // namespace hedgehop::sim
