#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/chunk_tree.h"
#include "sim/render/drawing_options.h"
#include "sim/render/frustum.h"
#include "sim/render/horizon.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// No higher than a sheet: ground, a ceiling.
inline bool lies_flat(const scenes::Chunk& chunk) { return chunk.box_W.sizes().z() <= 0.01f; }

/// A chunk is drawn as its far detail where nothing that is lost is wider in the image, px.
inline constexpr double kLostPx = 1.0;

/// Finds what a view can see of a scene's chunks. Reuses its memory from view to view.
class VisibleChunks {
 public:
  /// Who is told of a view's chunks while they are found, and knows what they hide.
  class Beholder {
   public:
    virtual ~Beholder() = default;
    /// @param stretch  as find() returns them.
    virtual void see(const scenes::Chunk& stretch) = 0;
    /// True only when nothing in a box can be seen past what was seen so far.
    virtual bool hides(const Eigen::AlignedBox3f& box_W) const = 0;
  };

  /// @param tiles  what flat chunks are made of, in the order of first_index.
  VisibleChunks(std::vector<scenes::Chunk> chunks, std::vector<scenes::Chunk> tiles);

  /// Stretches of the index buffer to draw, each a chunk or its far detail, in the order in which they hide each other
  /// best: upright chunks from near to far in plan, then flat ones, tile by tile, which seldom hide anything. The order
  /// does not depend on the culling. Which chunks are far depends on z in C of their boxes and on the focal length: the
  /// cameras of a rectified stereo pair see the same.
  std::span<const scenes::Chunk> find(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC,
                                      Culling culling);

  /// The same one by one, for a beholder instead of the horizon. Upright ones alone are seen before hides() is asked.
  void find(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, Culling culling,
            Beholder& beholder);

  /// Whether the view that was found last can see a box that is none of the chunks.
  bool shows(const Eigen::AlignedBox3f& box_W) const;

 private:
  struct Ranked {
    double distance_m = 0.0;
    uint32_t index = 0;
  };
  struct Farther;

  template <class Hides, class See>
  void visit(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, const Hides& hides,
             const See& see);
  template <class Hides, class See>
  void visit_tiles(const scenes::Chunk& flat, const Hides& hides, const See& see) const;

  std::vector<scenes::Chunk> chunks_, tiles_;
  ChunkTree tree_;
  Horizon horizon_;
  std::optional<Frustum> frustum_;  ///< of the view found last
  Culling culling_ = Culling::none;
  std::vector<Ranked> queue_;   ///< heap of nodes, nearest on top
  std::vector<uint32_t> flat_;  ///< chunks
  std::vector<scenes::Chunk> visible_;
};

}  // namespace hedgehop::sim
