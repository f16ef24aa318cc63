#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Boxes in a binary tree over the plan (north, east), built once: each node's box holds its two children's.
class ChunkTree {
 public:
  struct Node {
    Eigen::AlignedBox3f box_W;
    uint32_t first_child = 0;  ///< children are first_child and first_child + 1; 0 for a leaf
    uint32_t chunk = 0;        ///< of a leaf, index into the boxes given
  };

  explicit ChunkTree(std::span<const Eigen::AlignedBox3f> boxes_W);

  /// The root is node 0; no nodes when there were no boxes.
  std::span<const Node> nodes() const { return nodes_; }

 private:
  void split(uint32_t node, std::span<uint32_t> chunks, std::span<const Eigen::AlignedBox3f> boxes_W);

  std::vector<Node> nodes_;
};

}  // namespace hedgehop::sim
