#include "sim/render/chunk_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hedgehop::sim {

ChunkTree::ChunkTree(std::span<const Eigen::AlignedBox3f> boxes_W) {
  if (boxes_W.empty()) return;
  std::vector<uint32_t> chunks(boxes_W.size());
  std::iota(chunks.begin(), chunks.end(), 0u);
  nodes_.reserve(2 * chunks.size() - 1);
  nodes_.emplace_back();
  split(0, chunks, boxes_W);
}

void ChunkTree::split(uint32_t node, std::span<uint32_t> chunks, std::span<const Eigen::AlignedBox3f> boxes_W) {
  Eigen::AlignedBox3f box_W, centers_W;
  for (const uint32_t chunk : chunks) {
    box_W.extend(boxes_W[chunk]);
    centers_W.extend(boxes_W[chunk].center());
  }
  nodes_[node].box_W = box_W;
  nodes_[node].chunk = chunks.front();
  if (chunks.size() == 1) return;

  // Halve the chunks along the longer side of the plan; ties go by index, so that the tree is a function of its input.
  const int axis = centers_W.sizes().x() >= centers_W.sizes().y() ? 0 : 1;
  const auto key = [&](uint32_t chunk) { return std::pair(boxes_W[chunk].center()[axis], chunk); };
  const size_t half = chunks.size() / 2;
  std::nth_element(chunks.begin(), chunks.begin() + static_cast<std::ptrdiff_t>(half), chunks.end(),
                   [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  const auto first_child = static_cast<uint32_t>(nodes_.size());
  nodes_[node].first_child = first_child;
  nodes_.resize(nodes_.size() + 2);
  split(first_child, chunks.first(half), boxes_W);
  split(first_child + 1, chunks.subspan(half), boxes_W);
}

}  // namespace hedgehop::sim
