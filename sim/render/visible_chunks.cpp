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
    return X_WC.linear() * camera.ray_at_unit_depth({u_px, v_px});
  };
  const double right_px = camera.width_px + 0.5, bottom_px = camera.height_px + 0.5;
  return {ray(-1.5, -1.5), ray(right_px, -1.5), ray(-1.5, bottom_px), ray(right_px, bottom_px)};
}

double plan_distance_m(const Eigen::AlignedBox3f& box_W, const Eigen::Vector2d& eye_NE_m) {
  return Eigen::AlignedBox2d(box_W.min().head<2>().cast<double>(), box_W.max().head<2>().cast<double>())
      .exteriorDistance(eye_NE_m);
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

template <class Hides, class See>
void VisibleChunks::visit_tiles(const scenes::Chunk& flat, const Hides& hides, const See& see) const {
  const auto before = [](const scenes::Chunk& tile, uint32_t index) { return tile.first_index < index; };
  auto tile = std::lower_bound(tiles_.begin(), tiles_.end(), flat.first_index, before);
  scenes::Chunk stretch;
  for (; tile != tiles_.end() && tile->first_index < flat.first_index + flat.index_count; ++tile) {
    if (culling_ != Culling::none && (!frustum_->may_see(tile->box_W) || hides(tile->box_W))) continue;
    if (stretch.index_count > 0 && tile->first_index == stretch.first_index + stretch.index_count) {
      stretch.index_count += tile->index_count;
      stretch.box_W.extend(tile->box_W);
      continue;
    }
    if (stretch.index_count > 0) see(stretch);
    stretch = *tile;
  }
  if (stretch.index_count > 0) see(stretch);
}

/// @param hides  of a box, past what was seen before.
template <class Hides, class See>
void VisibleChunks::visit(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC,
                          const Hides& hides, const See& see) {
  const Frustum& frustum = frustum_.emplace(camera, X_WC, kNearPlaneM);
  const FarDetails far_details(camera, X_WC);
  queue_.clear();
  flat_.clear();
  const auto push = [&](uint32_t node) {
    const Eigen::AlignedBox3f& box_W = tree_.nodes()[node].box_W;
    if (culling_ != Culling::none && !frustum.may_see(box_W)) return;
    queue_.push_back({plan_distance_m(box_W, X_WC.translation().head<2>()), node});
    std::push_heap(queue_.begin(), queue_.end(), Farther{});
  };

  // What stands up, from near to far: each chunk hides some of those behind it.
  if (!tree_.nodes().empty()) push(0);
  while (!queue_.empty()) {
    const ChunkTree::Node& node = tree_.nodes()[queue_.front().index];
    std::pop_heap(queue_.begin(), queue_.end(), Farther{});
    queue_.pop_back();
    if (culling_ == Culling::frustum_and_horizon && hides(node.box_W)) continue;
    if (node.first_child != 0) {
      push(node.first_child);
      push(node.first_child + 1);
    } else if (lies_flat(chunks_[node.chunk])) {
      flat_.push_back(node.chunk);
    } else if (chunks_[node.chunk].index_count > 0) {
      see(far_details.detail_for_view(chunks_[node.chunk]));
    }
  }
  const auto hidden = [&](const Eigen::AlignedBox3f& box_W) {
    return culling_ == Culling::frustum_and_horizon && hides(box_W);
  };
  for (const uint32_t chunk : flat_) visit_tiles(chunks_[chunk], hidden, see);
}

std::span<const scenes::Chunk> VisibleChunks::find(const vision::camera::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& X_WC, Culling culling) {
  culling_ = culling;
  horizon_.reset(X_WC.translation());
  horizon_.look(corner_rays(camera, X_WC));
  visible_.clear();
  visit(
      camera, X_WC, [&](const Eigen::AlignedBox3f& box_W) { return horizon_.hides(box_W); },
      [&](const scenes::Chunk& stretch) {
        visible_.push_back(stretch);
        if (culling_ == Culling::frustum_and_horizon && stretch.fills_box_to_ground) horizon_.raise(stretch.box_W);
      });
  return visible_;
}

void VisibleChunks::find(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, Culling culling,
                         Beholder& beholder) {
  culling_ = culling;
  visit(
      camera, X_WC, [&](const Eigen::AlignedBox3f& box_W) { return beholder.hides(box_W); },
      [&](const scenes::Chunk& stretch) { beholder.see(stretch); });
  culling_ = std::min(culling, Culling::frustum);  // of what shows() knows
}

}  // namespace hedgehop::sim
