#include "sim/render/tiles/frame_memory.h"

#include <algorithm>

namespace hedgehop::sim::tiles {

FrameMemory::FrameMemory(size_t facets) {
  constexpr size_t kTypicalCount = 1 << 14;
  surfaces_.resize(std::min(facets, kTypicalCount));
  interpolants_.resize(surfaces_.size());
  pool_.resize(kTypicalCount);
  frame_.memory = this;
}

Frame& FrameMemory::begin(const PinholeImage& lens, int samples) {
  Frame& frame = frame_;
  frame.lens = lens;
  frame.across = (lens.width_px + kTilePx - 1) / kTilePx;
  frame.down = (lens.height_px + kTilePx - 1) / kTilePx;
  frame.samples = samples;
  const auto grid_tiles = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  tiles_.resize(grid_tiles * static_cast<size_t>(samples));
  frame.tiles = tiles_.data();
  size_t i = 0;
  for (; i < grid_tiles; ++i) {
    const int x = static_cast<int>(i) % frame.across, y = static_cast<int>(i) / frame.across;
    Tile& tile = tiles_[i];
    tile.covered = beyond(lens.width_px - kTilePx * x, lens.height_px - kTilePx * y);
    tile.farthest = 0.0f;
    tile.count = 0;
    tile.capacity = kOwnLayers;
  }
  for (; i < tiles_.size(); ++i) tiles_[i] = tiles_[i - grid_tiles];
  poses_.clear();
  frame.surface_count = 0;
  pool_used_ = 0;
  return frame;
}

void FrameMemory::add_pose(const ViewPose& pose) {
  poses_.push_back(pose);
  frame_.poses = poses_.data();
}

void FrameMemory::reserve_surfaces(size_t count) {
  const size_t needed = frame_.surface_count + count;
  if (surfaces_.size() < needed) surfaces_.resize(std::max(needed, 2 * surfaces_.size()));
  frame_.surfaces = surfaces_.data();
}

void FrameMemory::reserve_interpolants() {
  if (interpolants_.size() < frame_.surface_count) interpolants_.resize(surfaces_.size());
  frame_.interpolants = interpolants_.data();
}

uint32_t FrameMemory::take_layers(size_t count) {
  const size_t first = pool_used_;
  pool_used_ += count;
  if (pool_.size() < pool_used_) pool_.resize(std::max(pool_used_, 2 * pool_.size()));
  frame_.pool = pool_.data();
  return static_cast<uint32_t>(first);
}

/// A tile has at most one layer per pixel, so that three calls reach the maximum capacity.
void grow(Frame& frame, Tile& tile) {
  constexpr uint16_t kFactor = 6;
  const auto capacity = static_cast<uint16_t>(kFactor * tile.capacity);
  const uint32_t first = frame.memory->take_layers(capacity);
  std::copy_n(layers(frame, tile), tile.count, frame.pool + first);
  tile.first = first;
  tile.capacity = capacity;
}

}  // namespace hedgehop::sim::tiles
