#include "sim/render/visible_chunks.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "sim/render/frustum.h"

namespace hedgehop::sim {

namespace {

constexpr float kFlatM = 0.01f;  // no higher than this: a sheet

std::vector<Eigen::AlignedBox3f> boxes(const std::vector<scenes::Chunk>& chunks) {
  std::vector<Eigen::AlignedBox3f> boxes_W;
  for (const scenes::Chunk& chunk : chunks) boxes_W.push_back(chunk.box_W);
  return boxes_W;
}

}  // namespace

/// Orders a heap so that its top is the nearest; ties go by index.
struct VisibleChunks::Farther {
  bool operator()(const Ranked& a, const Ranked& b) const {
    return std::tie(a.distance_m, a.index) > std::tie(b.distance_m, b.index);
  }
};

VisibleChunks::VisibleChunks(std::vector<scenes::Chunk> chunks) : chunks_(std::move(chunks)), tree_(boxes(chunks_)) {
  queue_.reserve(chunks_.size());
  pending_.reserve(chunks_.size());
  upright_.reserve(chunks_.size());
  flat_.reserve(chunks_.size());
}

void VisibleChunks::raise_passed(double distance_m) {
  while (!pending_.empty() && pending_.front().distance_m <= distance_m) {
    horizon_.raise(chunks_[pending_.front().index].box_W);
    std::pop_heap(pending_.begin(), pending_.end(), Farther{});
    pending_.pop_back();
  }
}

std::span<const scenes::Chunk> VisibleChunks::find(const CameraView& view, Culling culling) {
  const Frustum frustum(view.camera, view.X_WC, kNearPlaneM);
  const bool use_horizon = culling == Culling::frustum_and_horizon;
  horizon_.reset(view.X_WC.translation());
  queue_.clear();
  pending_.clear();
  upright_.clear();
  flat_.clear();
  const auto push = [&](uint32_t node) {
    const Eigen::AlignedBox3f& box_W = tree_.nodes()[node].box_W;
    if (culling != Culling::none && !frustum.may_see(box_W)) return;
    queue_.push_back({horizon_.nearest_m(box_W), node});
    std::push_heap(queue_.begin(), queue_.end(), Farther{});
  };

  if (!tree_.nodes().empty()) push(0);
  while (!queue_.empty()) {
    const Ranked nearest = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), Farther{});
    queue_.pop_back();
    const ChunkTree::Node& node = tree_.nodes()[nearest.index];
    if (use_horizon) {
      raise_passed(nearest.distance_m);
      if (horizon_.hides(node.box_W)) continue;
    }
    if (node.first_child != 0) {
      push(node.first_child);
      push(node.first_child + 1);
      continue;
    }
    const scenes::Chunk& chunk = chunks_[node.chunk];
    (chunk.box_W.sizes().z() <= kFlatM ? flat_ : upright_).push_back(chunk);
    if (use_horizon && chunk.fills_box_to_ground) {
      pending_.push_back({horizon_.farthest_m(chunk.box_W), node.chunk});
      std::push_heap(pending_.begin(), pending_.end(), Farther{});
    }
  }
  upright_.insert(upright_.end(), flat_.begin(), flat_.end());
  return upright_;
}

}  // namespace hedgehop::sim
