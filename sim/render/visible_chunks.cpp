#include "sim/render/visible_chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace hedgehop::sim {

namespace {

std::vector<Eigen::AlignedBox3f> boxes(const std::vector<scenes::Chunk>& chunks) {
  std::vector<Eigen::AlignedBox3f> boxes_W;
  for (const scenes::Chunk& chunk : chunks) boxes_W.push_back(chunk.box_W);
  return boxes_W;
}

/// In W, a pixel outside the image's outermost.
std::array<Eigen::Vector3d, 4> corner_rays(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC) {
  const auto ray = [&](double u_px, double v_px) -> Eigen::Vector3d {
    return X_WC.linear() * camera.ray({u_px, v_px});
  };
  const double right_px = camera.width_px + 0.5, bottom_px = camera.height_px + 0.5;
  return {ray(-1.5, -1.5), ray(right_px, -1.5), ray(-1.5, bottom_px), ray(right_px, bottom_px)};
}

/// Finds the chunks that an image is too coarse for.
class FarDetails {
 public:
  FarDetails(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC)
      : forward_W_(X_WC.linear().col(2)),
        eye_m_(forward_W_.dot(X_WC.translation())),
        z_per_lost_(std::max(camera.focal_x_px, camera.focal_y_px) / kLostPx) {}

  scenes::Chunk detail_for_view(const scenes::Chunk& chunk) const {
    if (chunk.far.index_count == 0 || nearest_z_m(chunk.box_W) < z_per_lost_ * chunk.far.lost_m) return chunk;
    scenes::Chunk far = chunk;
    far.first_index = chunk.far.first_index;
    far.index_count = chunk.far.index_count;
    return far;
  }

 private:
  double nearest_z_m(const Eigen::AlignedBox3f& box_W) const {
    const double half_m = 0.5 * forward_W_.cwiseAbs().dot(box_W.sizes().cast<double>());
    return forward_W_.dot(box_W.center().cast<double>()) - half_m - eye_m_;
  }

  Eigen::Vector3d forward_W_;
  double eye_m_;
  double z_per_lost_;
};

}  // namespace

/// Orders a heap so that its top is the nearest; ties go by index.
struct VisibleChunks::Farther {
  bool operator()(const Ranked& a, const Ranked& b) const {
    return std::tie(a.distance_m, a.index) > std::tie(b.distance_m, b.index);
  }
};

VisibleChunks::VisibleChunks(std::vector<scenes::Chunk> chunks, std::vector<scenes::Chunk> tiles)
    : chunks_(std::move(chunks)), tiles_(std::move(tiles)), tree_(boxes(chunks_)) {
  queue_.reserve(chunks_.size());
  flat_.reserve(chunks_.size());
  visible_.reserve(chunks_.size() + tiles_.size());
}

bool VisibleChunks::shows(const Eigen::AlignedBox3f& box_W) const {
  if (culling_ == Culling::none) return true;
  return frustum_->may_see(box_W) && (culling_ == Culling::frustum || !horizon_.hides(box_W));
}

void VisibleChunks::add_tiles(const scenes::Chunk& flat) {
  const auto before = [](const scenes::Chunk& tile, uint32_t index) { return tile.first_index < index; };
  auto tile = std::lower_bound(tiles_.begin(), tiles_.end(), flat.first_index, before);
  uint32_t end = std::numeric_limits<uint32_t>::max();  // of the stretch that the last tile belongs to
  for (; tile != tiles_.end() && tile->first_index < flat.first_index + flat.index_count; ++tile) {
    if (!shows(tile->box_W)) continue;
    if (tile->first_index == end) {
      visible_.back().index_count += tile->index_count;
    } else {
      visible_.push_back(*tile);
    }
    end = tile->first_index + tile->index_count;
  }
}

std::span<const scenes::Chunk> VisibleChunks::find(const vision::camera::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& X_WC, Culling culling) {
  const Frustum& frustum = frustum_.emplace(camera, X_WC, kNearPlaneM);
  culling_ = culling;
  const FarDetails far_details(camera, X_WC);
  const bool use_horizon = culling == Culling::frustum_and_horizon;
  horizon_.reset(X_WC.translation());
  horizon_.look(corner_rays(camera, X_WC));
  queue_.clear();
  flat_.clear();
  visible_.clear();
  const auto push = [&](uint32_t node) {
    const Eigen::AlignedBox3f& box_W = tree_.nodes()[node].box_W;
    if (culling != Culling::none && !frustum.may_see(box_W)) return;
    queue_.push_back({horizon_.nearest_m(box_W), node});
    std::push_heap(queue_.begin(), queue_.end(), Farther{});
  };

  // What stands up, from near to far: each chunk hides some of those behind it.
  if (!tree_.nodes().empty()) push(0);
  while (!queue_.empty()) {
    const ChunkTree::Node& node = tree_.nodes()[queue_.front().index];
    std::pop_heap(queue_.begin(), queue_.end(), Farther{});
    queue_.pop_back();
    if (use_horizon && horizon_.hides(node.box_W)) continue;
    if (node.first_child != 0) {
      push(node.first_child);
      push(node.first_child + 1);
    } else if (lies_flat(chunks_[node.chunk])) {
      flat_.push_back(node.chunk);
    } else {
      if (chunks_[node.chunk].index_count > 0) visible_.push_back(far_details.detail_for_view(chunks_[node.chunk]));
      if (use_horizon && chunks_[node.chunk].fills_box_to_ground) horizon_.raise(node.box_W);
    }
  }
  for (const uint32_t chunk : flat_) add_tiles(chunks_[chunk]);
  return visible_;
}

}  // namespace hedgehop::sim
