#include "sim/render/tiles/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hedgehop::sim::tiles {
namespace {

using Boxes = std::span<const Eigen::AlignedBox3f>;

/// Boxes that share a child of a node.
struct Part {
  std::span<uint32_t> members;
  Eigen::AlignedBox3f box_W;

  /// The expected number of tests: the members, as often as a camera of about their height sees their box.
  float cost() const {
    const Eigen::Vector3f size_m = box_W.sizes();
    return members.size() > 1 ? static_cast<float>(members.size()) * (size_m.x() + size_m.y()) : -1.0f;
  }
};

/// @param members  not empty.
Part part_of(std::span<uint32_t> members, Boxes boxes_W) {
  Part part{members, {}};
  for (const uint32_t box : members) part.box_W.extend(boxes_W[box]);
  return part;
}

/// Halves a part with at least two members along the longer side of the plan.
std::pair<Part, Part> halves(const Part& part, Boxes boxes_W) {
  const int axis = part.box_W.sizes().x() >= part.box_W.sizes().y() ? 0 : 1;
  // Equal centers are ordered by index, so that the tree is unique.
  const auto key = [&](uint32_t box) { return std::pair(boxes_W[box].center()[axis], box); };
  const size_t half = part.members.size() / 2;
  std::ranges::nth_element(part.members, part.members.begin() + static_cast<std::ptrdiff_t>(half), {}, key);
  return {part_of(part.members.first(half), boxes_W), part_of(part.members.subspan(half), boxes_W)};
}

}  // namespace

BoxTree::BoxTree(Boxes boxes_W) {
  if (boxes_W.empty()) return;
  std::vector<uint32_t> members(boxes_W.size());
  std::iota(members.begin(), members.end(), 0u);
  leaves_.reserve(members.size());
  add_node(members, boxes_W);
}

uint32_t BoxTree::add_node(std::span<uint32_t> members, Boxes boxes_W) {
  constexpr size_t kLanes = 8;
  std::vector<Part> parts{part_of(members, boxes_W)};
  while (parts.size() < kLanes) {
    const auto costliest = std::ranges::max_element(parts, {}, &Part::cost);
    if (costliest->members.size() == 1) break;
    const auto [a, b] = halves(*costliest, boxes_W);
    *costliest = a;
    parts.push_back(b);
  }
  Node node{};
  node.lanes = (1u << parts.size()) - 1;
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const Part& part = parts[lane < parts.size() ? lane : 0];
    for (int i = 0; i < 3; ++i) {
      node.boxes_W.low_m[i][lane] = part.box_W.min()[i];
      node.boxes_W.high_m[i][lane] = part.box_W.max()[i];
    }
  }
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (size_t lane = 0; lane < parts.size(); ++lane) {
    const std::span<uint32_t> its = parts[lane].members;
    if (its.size() > 1) {
      node.children[lane] = add_node(its, boxes_W);
    } else {
      node.children[lane] = kLeaf | static_cast<uint32_t>(leaves_.size());
      leaves_.push_back(its.front());
    }
  }
  nodes_[index] = node;
  return index;
}

}  // namespace hedgehop::sim::tiles
