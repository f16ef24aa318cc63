#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/drawing_options.h"
#include "sim/render/horizon.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Distance of the near plane, z in C. Closer surfaces are not drawn.
inline constexpr double kNearPlaneM = 0.05;

/// The space that a camera can see: four side planes and the near plane, no far plane.
class Frustum {
 public:
  /// @param X_WC  pose of the camera. @param near_m  z in C of the near plane.
  Frustum(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, double near_m);

  /// Returns false only if the whole box is outside. The sides have a margin of one pixel around the image.
  bool may_see(const Eigen::AlignedBox3f& box_W) const;

 private:
  struct Plane {
    Eigen::Vector3d n_W;  ///< inwards
    double offset = 0.0;  ///< n_W . p_W + offset >= 0 inside
  };
  std::array<Plane, 5> planes_;
};

/// Boxes in a binary tree over the plan (north, east), built once. The box of a node contains the boxes of its
/// children.
class ChunkTree {
 public:
  struct Node {
    Eigen::AlignedBox3f box_W;
    uint32_t first_child = 0;  ///< the children are first_child and first_child + 1; 0 for a leaf
    uint32_t chunk = 0;        ///< of a leaf: index of its box in the list of boxes
  };

  explicit ChunkTree(std::span<const Eigen::AlignedBox3f> boxes_W);

  /// The nodes; node 0 is the root. Empty if the list of boxes was empty.
  std::span<const Node> nodes() const { return nodes_; }

 private:
  void split(uint32_t node, std::span<uint32_t> chunks, std::span<const Eigen::AlignedBox3f> boxes_W);

  std::vector<Node> nodes_;
};

/// Returns whether the chunk is a horizontal sheet, such as the ground or a ceiling.
inline bool lies_flat(const scenes::Chunk& chunk) { return chunk.box_W.sizes().z() <= 0.01f; }

/// Finds the chunks of a scene that a view can see. Reuses its memory from view to view.
class VisibleChunks {
 public:
  /// @param tiles  the parts of the flat chunks, in the order of first_index.
  VisibleChunks(std::vector<scenes::Chunk> chunks, std::vector<scenes::Chunk> tiles);

  /// Returns the stretches of the index buffer to draw. Each stretch is a chunk or its far detail. Upright chunks come
  /// first, from near to far in plan, because they hide the others; then the flat ones, tile by tile. The order does
  /// not depend on the culling.
  std::span<const scenes::Chunk> find(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC,
                                      Culling culling);

  /// Returns whether the view found last can see a box that is not one of the chunks.
  bool shows(const Eigen::AlignedBox3f& box_W) const;

 private:
  struct RankedNode {
    double distance_m = 0.0;
    uint32_t index = 0;
  };
  struct IsFarther;

  bool hidden(const Eigen::AlignedBox3f& box_W) const;
  void add(const scenes::Chunk& stretch);
  void add_tiles(const scenes::Chunk& flat);

  std::vector<scenes::Chunk> chunks_, tiles_;
  ChunkTree tree_;
  Horizon horizon_;
  std::optional<Frustum> frustum_;  ///< of the view found last
  Culling culling_ = Culling::none;
  std::vector<RankedNode> queue_;  ///< heap; the nearest node is on top
  std::vector<uint32_t> flat_;     ///< flat chunks of the view
  std::vector<scenes::Chunk> visible_;
};

}  // namespace hedgehop::sim
