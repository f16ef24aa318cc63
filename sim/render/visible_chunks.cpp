#include "sim/render/visible_chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/render/far_details.h"

namespace hedgehop::sim {

Frustum::Frustum(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, double near_m) {
  constexpr double kEdgePx =
      1.5;  // half a pixel to the edge of the image, and a margin of one pixel for the rasterizer
  const double left = camera.center_u_px + kEdgePx, right = camera.width_px - 1 + kEdgePx - camera.center_u_px;
  const double above = camera.center_v_px + kEdgePx, below = camera.height_px - 1 + kEdgePx - camera.center_v_px;
  const std::array<Eigen::Vector3d, 5> normals_C = {{{camera.focal_x_px, 0.0, left},
                                                     {-camera.focal_x_px, 0.0, right},
                                                     {0.0, camera.focal_y_px, above},
                                                     {0.0, -camera.focal_y_px, below},
                                                     {0.0, 0.0, 1.0}}};
  for (size_t i = 0; i < planes_.size(); ++i) {
    planes_[i].n_W = X_WC.linear() * normals_C[i];
    planes_[i].offset = -planes_[i].n_W.dot(X_WC.translation());
  }
  planes_.back().offset -= 0.5 * near_m;
}

bool Frustum::may_see(const Eigen::AlignedBox3f& box_W) const {
  for (const Plane& plane : planes_) {
    double furthest_inside = plane.offset;
    for (int i = 0; i < 3; ++i) {
      furthest_inside += plane.n_W[i] * static_cast<double>(plane.n_W[i] > 0.0 ? box_W.max()[i] : box_W.min()[i]);
    }
    if (furthest_inside < 0.0) return false;
  }
  return true;
}

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

  // Halve the chunks along the longer side of the plan. Equal centers are ordered by index, so that the tree is unique.
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

namespace {

std::vector<Eigen::AlignedBox3f> boxes(const std::vector<scenes::Chunk>& chunks) {
  std::vector<Eigen::AlignedBox3f> boxes_W;
  for (const scenes::Chunk& chunk : chunks) boxes_W.push_back(chunk.box_W);
  return boxes_W;
}

/// Returns rays in W through points one pixel outside the corner pixels.
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

}  // namespace

/// Order of a heap with the nearest node on top. Equal distances are ordered by index.
struct VisibleChunks::IsFarther {
  bool operator()(const RankedNode& a, const RankedNode& b) const {
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

bool VisibleChunks::hidden(const Eigen::AlignedBox3f& box_W) const {
  return culling_ == Culling::frustum_and_horizon && horizon_.hides(box_W);
}

void VisibleChunks::add(const scenes::Chunk& stretch) {
  visible_.push_back(stretch);
  if (culling_ != Culling::frustum_and_horizon) return;
  if (stretch.fills_box_to_ground) {
    horizon_.add_occluder(stretch.box_W);
  } else if (!stretch.core_W.isEmpty()) {
    horizon_.add_occluder(stretch.core_W);
  }
}

void VisibleChunks::add_tiles(const scenes::Chunk& flat) {
  const auto before = [](const scenes::Chunk& tile, uint32_t index) { return tile.first_index < index; };
  auto tile = std::lower_bound(tiles_.begin(), tiles_.end(), flat.first_index, before);
  scenes::Chunk stretch;
  for (; tile != tiles_.end() && tile->first_index < flat.first_index + flat.index_count; ++tile) {
    if (culling_ != Culling::none && (!frustum_->may_see(tile->box_W) || hidden(tile->box_W))) continue;
    if (stretch.index_count > 0 && tile->first_index == stretch.first_index + stretch.index_count) {
      stretch.index_count += tile->index_count;
      stretch.box_W.extend(tile->box_W);
      continue;
    }
    if (stretch.index_count > 0) add(stretch);
    stretch = *tile;
  }
  if (stretch.index_count > 0) add(stretch);
}

std::span<const scenes::Chunk> VisibleChunks::find(const vision::camera::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& X_WC, Culling culling) {
  culling_ = culling;
  horizon_.reset(X_WC.translation());
  horizon_.limit_to_view(corner_rays(camera, X_WC));
  const Frustum& frustum = frustum_.emplace(camera, X_WC, kNearPlaneM);
  const FarDetails far_details(camera, X_WC);
  visible_.clear();
  queue_.clear();
  flat_.clear();
  const auto push = [&](uint32_t node) {
    const Eigen::AlignedBox3f& box_W = tree_.nodes()[node].box_W;
    if (culling_ != Culling::none && !frustum.may_see(box_W)) return;
    queue_.push_back({plan_distance_m(box_W, X_WC.translation().head<2>()), node});
    std::push_heap(queue_.begin(), queue_.end(), IsFarther{});
  };

  // Upright chunks from near to far: each chunk may hide others behind it.
  if (!tree_.nodes().empty()) push(0);
  while (!queue_.empty()) {
    const ChunkTree::Node& node = tree_.nodes()[queue_.front().index];
    std::pop_heap(queue_.begin(), queue_.end(), IsFarther{});
    queue_.pop_back();
    if (hidden(node.box_W)) continue;
    if (node.first_child != 0) {
      push(node.first_child);
      push(node.first_child + 1);
    } else if (lies_flat(chunks_[node.chunk])) {
      flat_.push_back(node.chunk);
    } else if (chunks_[node.chunk].index_count > 0) {
      add(far_details.detail_for_view(chunks_[node.chunk]));
    }
  }
  for (const uint32_t chunk : flat_) add_tiles(chunks_[chunk]);
  return visible_;
}

}  // namespace hedgehop::sim
