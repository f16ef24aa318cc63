#include "vision/mapping/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::mapping {
namespace {

// Log-odds in steps of 0.4: a hit adds 1.2, a miss subtracts 0.8. Voxels in free space soon count as free again,
// because the entire block around the ray is free.
constexpr int kHit = 3, kMiss = -2;
constexpr int kMinLogOdds = -9,
              kMaxLogOdds = 12;  // limits: a free voxel is no longer free after two hits and occupied after five
constexpr int kFreeBelow = -4, kOccupiedFrom = 5;
constexpr double kSigmas = 2.0;
// A thin object reduces the evidence for free space along its ray: within two sigma of its matched depth or, unmatched
// in front of the sky, beyond the range at which it would be matched. Unmatched, it makes voxels unknown after three
// images. Matched, it occupies free voxels after four: no margin is kept from unknown ones.
constexpr int kDoubt = 2, kMatchedInFree = 5;
constexpr float kSurelyMatchedM = 4.0F;
// Bits of marks_.
constexpr uint8_t kHitNow = 1, kDoubted = 2;
// Maximum 1-sigma of depth of surfaces added to the map, less than a voxel, and of surfaces reported in hits().
constexpr double kPlacedM = 0.25, kReportedM = 1.0;

int modulo(int a, int n) {
  const int m = a % n;
  return m < 0 ? m + n : m;
}

bool is_within(std::span<const OccupancyMap::MovingDisc> discs, const Eigen::Vector3d& p_W) {
  return std::ranges::any_of(discs,
                             [&](const auto& disc) { return (p_W.head<2>() - disc.p_W).norm() < disc.radius_m; });
}

/// View of a row of voxels: its first center in C, the distance between centers, and the image in blocks.
struct RowView {
  Eigen::Vector3f p_C, step_C;
  float f, u0, v0;  ///< focal length and image center, blocks
  int cols, rows;
  float near_m, far_m;  ///< range of z in C
};

constexpr int kLanes = 8;
using Floats [[gnu::vector_size(kLanes * sizeof(float))]] = float;
using Ints [[gnu::vector_size(kLanes * sizeof(int))]] = int;

/// Computes the z in C of each voxel and the block that shows it; -1 outside the view. @param count  multiple of
/// kLanes.
HEDGEHOP_WIDE void find_blocks(const RowView& view, int count, float* z_m, int* block) {
  const float x = view.p_C.x(), y = view.p_C.y(), z = view.p_C.z();
  const float dx = view.step_C.x(), dy = view.step_C.y(), dz = view.step_C.z();
  const auto cols = static_cast<float>(view.cols), rows = static_cast<float>(view.rows);
  Floats steps = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
  for (int i = 0; i < count; i += kLanes, steps += static_cast<float>(kLanes)) {
    const Floats depth_m = z + steps * dz;
    const Floats u = view.u0 + view.f * (x + steps * dx) / depth_m, v = view.v0 + view.f * (y + steps * dy) / depth_m;
    const Ints seen =
        (depth_m > view.near_m) & (depth_m <= view.far_m) & (u >= 0.0F) & (v >= 0.0F) & (u < cols) & (v < rows);
    const Ints col = __builtin_convertvector(seen ? u : Floats{}, Ints),
               row = __builtin_convertvector(seen ? v : Floats{}, Ints);
    const Ints at = (row * view.cols + col) | ~seen;
    std::memcpy(z_m + i, &depth_m, sizeof depth_m);
    std::memcpy(block + i, &at, sizeof at);
  }
}

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyMapConfig& config) : config_(config) {
  if (!(config.voxel_m > 0.0 && config.across > 0 && config.layers > 0 && config.noise_px > 0.0 &&
        config.far_m > 0.0)) {
    throw std::invalid_argument("an occupancy map needs voxels, noise and range above 0");
  }
  const size_t count =
      static_cast<size_t>(config.across) * static_cast<size_t>(config.across) * static_cast<size_t>(config.layers);
  log_odds_.assign(count, 0);
  marks_.assign(count, 0);
}

OccupancyMap::Index OccupancyMap::index(const Eigen::Vector3d& p_W) const {
  return (p_W / config_.voxel_m).array().floor().cast<int>();
}

Eigen::Vector3d OccupancyMap::center(const Index& voxel) const {
  return config_.voxel_m * (voxel.cast<double>() + Eigen::Vector3d::Constant(0.5));
}

bool OccupancyMap::contains(const Index& voxel) const {
  return ((voxel - first_).array() >= 0).all() && ((voxel - first_).array() < size().array()).all();
}

size_t OccupancyMap::slot(const Index& voxel) const {
  const int n = config_.across;
  return (static_cast<size_t>(modulo(voxel.z(), config_.layers)) * static_cast<size_t>(n) +
          static_cast<size_t>(modulo(voxel.x(), n))) *
             static_cast<size_t>(n) +
         static_cast<size_t>(modulo(voxel.y(), n));
}

void OccupancyMap::reset(const Eigen::Vector3d& center_W) {
  first_ = index(center_W) - size() / 2;
  std::ranges::fill(log_odds_, int8_t{0});
}

void OccupancyMap::move(const Eigen::Vector3d& center_W) {
  const Index before = first_, wanted = index(center_W) - size() / 2;
  if (wanted == before) return;
  first_ = wanted;
  const Index n = size();
  const auto stays = [&](int axis, int i) { return i >= before[axis] && i < before[axis] + n[axis]; };
  for (int z = first_.z(); z < first_.z() + n.z(); ++z) {
    for (int x = first_.x(); x < first_.x() + n.x(); ++x) {
      const size_t row = slot({x, 0, z});
      if (!stays(2, z) || !stays(0, x)) {
        std::fill_n(log_odds_.begin() + static_cast<std::ptrdiff_t>(row), n.y(), int8_t{0});
        continue;
      }
      const int steps = first_.y() - before.y();
      const int begin = steps > 0 ? std::max(first_.y(), before.y() + n.y()) : first_.y();
      const int end = steps > 0 ? first_.y() + n.y() : std::min(first_.y() + n.y(), before.y());
      for (int y = begin; y < end; ++y) log_odds_[slot({x, y, z})] = 0;
    }
  }
}

void OccupancyMap::integrate(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry,
                             const Eigen::Isometry3d& X_WC, std::span<const MovingDisc> moving, Instant instant) {
  if (instant == Instant::next) {
    for (const size_t slot : doubted_slots_) marks_[slot] = 0;
    doubted_slots_.clear();
  }
  find_clear(blocks, geometry);
  add_hits(blocks, geometry, X_WC, moving);
  add_misses(blocks, geometry, X_WC, moving);
  for (const size_t slot : hit_slots_) marks_[slot] &= kDoubted;
}

double OccupancyMap::noise_px(const DepthBlock& block) const {
  return block.sigma16 < 0 ? config_.noise_px : std::max<int>(block.sigma16, 1) / stereo::kDisparityUnits;
}

/// Computes the z in C up to which each block is free. It is limited by nearer surfaces in adjacent blocks, whose edges
/// may be inside the block. Also computes the range in which a thin object may be.
void OccupancyMap::find_clear(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry) {
  const auto beyond16 = [&](const DepthBlock& block) { return kSigmas * noise_px(block) * stereo::kDisparityUnits; };
  const auto z_m = [&](double d16) { return static_cast<float>(geometry.disparity16(1.0) / std::max(d16, 1.0)); };
  clear_m_.assign(static_cast<size_t>(blocks.rows() * blocks.cols()), 0.0F);
  doubts_.assign(clear_m_.size(), {0.0F, 0.0F});
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      const DepthBlock& block = blocks.at(row, col);
      float& clear_m = clear_m_[static_cast<size_t>(row * blocks.cols() + col)];
      Doubt& doubt = doubts_[static_cast<size_t>(row * blocks.cols() + col)];
      if (block.kind == DepthBlock::Kind::line) {
        doubt = {kSurelyMatchedM, std::numeric_limits<float>::max()};
      } else if (block.thin) {
        doubt = {z_m(block.near16 + beyond16(block)), z_m(block.near16 - beyond16(block)), true};
      }
      if (block.kind != DepthBlock::Kind::matched && block.kind != DepthBlock::Kind::sky &&
          block.kind != DepthBlock::Kind::plain) {
        continue;
      }
      double near16 = block.foot16 < 0 ? -1.0 : block.foot16 + kSigmas * config_.noise_px * stereo::kDisparityUnits;
      for (int v = std::max(0, row - 1); v <= std::min(blocks.rows() - 1, row + 1); ++v) {
        for (int u = std::max(0, col - 1); u <= std::min(blocks.cols() - 1, col + 1); ++u) {
          const DepthBlock& other = blocks.at(v, u);
          const int other16 =
              other.kind == DepthBlock::Kind::plain ? std::max(other.near16, other.foot16) : other.near16;
          if (other16 >= 0) near16 = std::max(near16, other16 + beyond16(other));
        }
      }
      double end_m = near16 < 0 ? config_.far_m : geometry.disparity16(1.0) / near16;
      if (block.kind == DepthBlock::Kind::sky) end_m = std::min(end_m, config_.far_m);
      clear_m = static_cast<float>(end_m);
    }
  }
}

/// Adds the end points of rays. Each voxel counts once per image.
void OccupancyMap::add_hits(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry,
                            const Eigen::Isometry3d& X_WC, std::span<const MovingDisc> moving) {
  hits_.clear();
  hit_slots_.clear();
  // z^2 sigma_px / (f b) = sigma_m
  const auto min_disparity16 = [&](const DepthBlock& block, double sigma_m) {
    return geometry.disparity16(std::sqrt(sigma_m * geometry.focal_px * geometry.baseline_m / noise_px(block)));
  };
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      const DepthBlock& block = blocks.at(row, col);
      const bool assumed = block.stands && block.near16 < 0;  // a surface without a match
      const int near16 = assumed ? block.foot16 : block.near16;
      if (near16 <= 0 || near16 < min_disparity16(block, kReportedM)) continue;
      const cv::Point middle(col * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx / 2,
                             row * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx / 2);
      const Eigen::Vector3d p_W = X_WC * Eigen::Vector3d(geometry.z_m(near16) * geometry.ray_at_unit_depth(middle));
      const Index voxel = index(p_W);
      if (!contains(voxel)) continue;
      const size_t at = slot(voxel);
      if ((marks_[at] & kHitNow) != 0) continue;
      if (!assumed && !block.thin) hits_.push_back({p_W, log_odds_[at] <= kFreeBelow});
      if (near16 < min_disparity16(block, kPlacedM)) continue;
      if (is_within(moving, p_W)) continue;
      marks_[at] |= kHitNow;
      hit_slots_.push_back(at);
      log_odds_[at] = static_cast<int8_t>(std::min(kMaxLogOdds, log_odds_[at] + kHit));
    }
  }
}

/// Updates the voxels that are completely in front of the end of their block's ray, and those behind a thin object.
void OccupancyMap::add_misses(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry,
                              const Eigen::Isometry3d& X_WC, std::span<const MovingDisc> moving) {
  const Eigen::Isometry3d X_CW = X_WC.inverse();
  const auto half_m = static_cast<float>(0.5 * config_.voxel_m);
  RowView view{.p_C = {},
               .step_C = (config_.voxel_m * X_CW.linear().col(1)).cast<float>(),
               .f = static_cast<float>(geometry.focal_px / DepthBlocks::kBlockPx),
               .u0 = static_cast<float>(geometry.center_u_px / DepthBlocks::kBlockPx),
               .v0 = static_cast<float>(geometry.center_v_px / DepthBlocks::kBlockPx),
               .cols = blocks.cols(),
               .rows = blocks.rows(),
               .near_m = half_m,
               .far_m = static_cast<float>(config_.voxel_m * config_.across)};
  const Index n = size();
  const int turn = n.y() - modulo(first_.y(), n.y());  // voxels of a row before the end of the ring buffer
  const int in_row = (n.y() + kLanes - 1) / kLanes * kLanes;
  std::vector<float> z_m(static_cast<size_t>(in_row));
  std::vector<int> block(z_m.size());
  for (int z = first_.z(); z < first_.z() + n.z(); ++z) {
    for (int x = first_.x(); x < first_.x() + n.x(); ++x) {
      view.p_C = (X_CW * center({x, first_.y(), z})).cast<float>();
      find_blocks(view, in_row, z_m.data(), block.data());
      size_t at = slot({x, first_.y(), z});
      for (int i = 0; i < n.y(); ++i, ++at) {
        if (i == turn) at -= static_cast<size_t>(n.y());
        const auto voxel = static_cast<size_t>(i);
        if (block[voxel] < 0) continue;
        const auto of = static_cast<size_t>(block[voxel]);
        int8_t& odds = log_odds_[at];
        if (z_m[voxel] + half_m <= clear_m_[of] && marks_[at] == 0) {
          odds = static_cast<int8_t>(std::max(kMinLogOdds, odds + kMiss));
        } else if (z_m[voxel] > doubts_[of].from_m && z_m[voxel] < doubts_[of].to_m) {
          const bool fixed = doubts_[of].matched && !is_within(moving, center({x, first_.y() + i, z}));
          const int most = fixed ? kOccupiedFrom : 0, step = fixed && odds <= kFreeBelow ? kMatchedInFree : kDoubt;
          if (odds < most) odds = static_cast<int8_t>(std::min(most, odds + step));
          if ((marks_[at] & kDoubted) != 0) continue;
          marks_[at] |= kDoubted;
          doubted_slots_.push_back(at);
        }
      }
    }
  }
}

void OccupancyMap::fade() {
  for (int8_t& l : log_odds_) l = static_cast<int8_t>(l - (l > 0) + (l < 0));
}

void OccupancyMap::clear_cylinder(const Eigen::Vector3d& center_W, double radius_m, double half_height_m) {
  const Eigen::Vector3d reach_m(radius_m, radius_m, half_height_m);
  const Index low = index(center_W - reach_m).cwiseMax(first_);
  const Index high = index(center_W + reach_m).cwiseMin(first_ + size() - Index::Ones());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        if ((center({x, y, z}) - center_W).head<2>().norm() > radius_m) continue;
        log_odds_[slot({x, y, z})] = kMinLogOdds;
      }
    }
  }
}

OccupancyMap::State OccupancyMap::state(const Index& voxel) const {
  if (!contains(voxel)) return State::unknown;
  const int l = log_odds_[slot(voxel)];
  return l <= kFreeBelow ? State::free : l >= kOccupiedFrom ? State::occupied : State::unknown;
}

void OccupancyMap::read_row(int layer, int north, std::vector<State>& row) const {
  const Index n = size();
  row.resize(static_cast<size_t>(n.y()));
  const int turn = n.y() - modulo(first_.y(), n.y());
  size_t at = slot({first_.x() + north, first_.y(), first_.z() + layer});
  for (int i = 0; i < n.y(); ++i, ++at) {
    if (i == turn) at -= static_cast<size_t>(n.y());
    const int l = log_odds_[at];
    row[static_cast<size_t>(i)] = l <= kFreeBelow ? State::free : l >= kOccupiedFrom ? State::occupied : State::unknown;
  }
}

}  // namespace hedgehop::vision::mapping
