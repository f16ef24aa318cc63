#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

/// Boxes in a tree over the plan (north, east) with up to eight children per node, built once.
class BoxTree {
 public:
  static constexpr uint32_t kLeaf = 0x80000000u;

  struct alignas(64) Node {
    EightBoxes boxes_W;    ///< of the children; a lane without a child repeats the first one
    uint32_t children[8];  ///< index of a node, or kLeaf plus the number of a leaf
    uint32_t lanes;        ///< lanes with a child, lane 0 in the lowest bit
  };

  BoxTree() = default;
  explicit BoxTree(std::span<const Eigen::AlignedBox3f> boxes_W);

  /// The nodes; node 0 is the root. Empty if the list of boxes was empty.
  std::span<const Node> nodes() const { return nodes_; }
  /// The index of each leaf's box in the list of boxes. Leaves with consecutive numbers are close to each other.
  std::span<const uint32_t> leaves() const { return leaves_; }

 private:
  uint32_t add_node(std::span<uint32_t> members, std::span<const Eigen::AlignedBox3f> boxes_W);

  std::vector<Node> nodes_;
  std::vector<uint32_t> leaves_;
};

}  // namespace hedgehop::sim::tiles
