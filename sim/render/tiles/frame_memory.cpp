#include "sim/render/tiles/frame_memory.h"

#include <algorithm>

namespace hedgehop::sim::tiles {

FrameMemory::FrameMemory(size_t facets) {
  constexpr size_t kOrdinary = 1 << 14;
  surfaces_.resize(std::min(facets, kOrdinary));
  paints_.resize(surfaces_.size());
  pool_.resize(kOrdinary);
  frame_.memory = this;
}

Frame& FrameMemory::begin(const Lens& lens, int samples) {
  Frame& frame = frame_;
  frame.lens = lens;
  frame.across = (lens.width_px + kTilePx - 1) / kTilePx;
  frame.down = (lens.height_px + kTilePx - 1) / kTilePx;
  frame.samples = samples;
  const auto a_grid = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  tiles_.resize(a_grid * static_cast<size_t>(samples));
  frame.tiles = tiles_.data();
  size_t i = 0;
  for (; i < a_grid; ++i) {
    const int x = static_cast<int>(i) % frame.across, y = static_cast<int>(i) / frame.across;
    Tile& tile = tiles_[i];
    tile.covered = beyond(lens.width_px - kTilePx * x, lens.height_px - kTilePx * y);
    tile.farthest = 0.0f;
    tile.count = 0;
    tile.capacity = kOwnLayers;
  }
  for (; i < tiles_.size(); ++i) tiles_[i] = tiles_[i - a_grid];
  eyes_.clear();
  frame.surface_count = 0;
  pool_used_ = 0;
  return frame;
}

void FrameMemory::add_eye(const Eye& eye) {
  eyes_.push_back(eye);
  frame_.eyes = eyes_.data();
}

void FrameMemory::make_room(size_t facets) {
  const size_t needed = frame_.surface_count + facets;
  if (surfaces_.size() < needed) surfaces_.resize(std::max(needed, 2 * surfaces_.size()));
  frame_.surfaces = surfaces_.data();
}

void FrameMemory::make_paints() {
  if (paints_.size() < frame_.surface_count) paints_.resize(surfaces_.size());
  frame_.paints = paints_.data();
}

uint32_t FrameMemory::take_layers(size_t count) {
  const size_t first = pool_used_;
  pool_used_ += count;
  if (pool_.size() < pool_used_) pool_.resize(std::max(pool_used_, 2 * pool_.size()));
  frame_.pool = pool_.data();
  return static_cast<uint32_t>(first);
}

/// A tile has at most one layer a pixel, so that three steps are enough.
void grow(Frame& frame, Tile& tile) {
  constexpr uint16_t kTimes = 6;
  const auto capacity = static_cast<uint16_t>(kTimes * tile.capacity);
  const uint32_t first = frame.memory->take_layers(capacity);
  std::copy_n(layers(frame, tile), tile.count, frame.pool + first);
  tile.first = first;
  tile.capacity = capacity;
}

}  // namespace hedgehop::sim::tiles
