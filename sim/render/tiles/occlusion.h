#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/simd.h"

namespace hedgehop::sim::tiles {
namespace {

/// Returns the pixels of a tile between two columns or rows, one bit each.
inline uint32_t in_tile(int tile, int first, int last) {
  const int before = first - kTilePx * tile, after = kTilePx * tile + kTilePx - 1 - last;
  return 0xffu & (0xffu << (before > 0 ? before : 0)) & (0xffu >> (after > 0 ? after : 0));
}

/// Returns whether all of the given pixels of a tile show a closer surface. @param nearest  max 1 / z of the box, 1/m.
inline bool hides(const Frame& frame, const Tile& tile, uint64_t pixels, float nearest) {
  if ((pixels & ~tile.covered) != 0) return false;
  if (tile.farthest > nearest) return true;
  const Layer* const layer = layers(frame, tile);
  for (uint16_t i = 0; pixels != 0; ++i) {  // each covered pixel is in one layer, or outside the image
    if (i == tile.count) return true;
    if ((layer[i].pixels & pixels) == 0) continue;
    if (!(layer[i].farthest > nearest)) return false;
    pixels &= ~layer[i].pixels;
  }
  return true;
}

/// As Kernels::hides_pixels.
inline bool hides_pixels(const Frame& frame, const PixelBox& box) {
  const size_t grid_tiles = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  for (int row = box.top / kTilePx; row <= box.bottom / kTilePx; ++row) {
    const uint64_t row_pixels = kByteMasks.bytes[in_tile(row, box.top, box.bottom)];
    const Tile* const tiles = frame.tiles + static_cast<size_t>(row) * static_cast<size_t>(frame.across);
    for (int column = box.left / kTilePx; column <= box.right / kTilePx; ++column) {
      const uint64_t pixels = row_pixels & (in_tile(column, box.left, box.right) * 0x0101010101010101u);
      for (int sample = 0; sample < frame.samples; ++sample) {
        const Tile& tile = tiles[static_cast<size_t>(sample) * grid_tiles + static_cast<size_t>(column)];
        if (!hides(frame, tile, pixels, box.nearest)) return false;
      }
    }
  }
  return true;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
