#include "sim/render/visible_chunks.h"

#include <algorithm>
#include <array>
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

/// In W, a pixel outside the picture's outermost.
std::array<Eigen::Vector3d, 4> corner_rays(const CameraView& view) {
  const auto ray = [&](double u_px, double v_px) -> Eigen::Vector3d {
    return view.X_WC.linear() * view.camera.ray({u_px, v_px});
  };
  const double right_px = view.camera.width_px + 0.5, bottom_px = view.camera.height_px + 0.5;
  return {ray(-1.5, -1.5), ray(right_px, -1.5), ray(-1.5, bottom_px), ray(right_px, bottom_px)};
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
  upright_.reserve(chunks_.size());
  flat_.reserve(chunks_.size());
}

std::span<const scenes::Chunk> VisibleChunks::find(const CameraView& view, Culling culling) {
  const Frustum frustum(view.camera, view.X_WC, kNearPlaneM);
  const bool use_horizon = culling == Culling::frustum_and_horizon;
  horizon_.reset(view.X_WC.translation());
  horizon_.look(corner_rays(view));
  queue_.clear();
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
    if (use_horizon && horizon_.hides(node.box_W)) continue;
    if (node.first_child != 0) {
      push(node.first_child);
      push(node.first_child + 1);
      continue;
    }
    const scenes::Chunk& chunk = chunks_[node.chunk];
    (chunk.box_W.sizes().z() <= kFlatM ? flat_ : upright_).push_back(chunk);
    if (use_horizon && chunk.fills_box_to_ground) horizon_.raise(chunk.box_W);
  }
  upright_.insert(upright_.end(), flat_.begin(), flat_.end());
  return upright_;
}

}  // namespace hedgehop::sim
