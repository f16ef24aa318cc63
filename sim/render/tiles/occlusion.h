#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/simd.h"

namespace hedgehop::sim::tiles {
namespace {

/// An interval of pixel columns or rows, both ends included; empty if last < first.
struct PixelInterval {
  int first, last;

  /// The pixels between low and high. @param size  of the image, px.
  PixelInterval(float low, float high, int size) {
    const auto end = static_cast<float>(size - 1);
    const float from = low > 0.0f ? low : 0.0f, to = high < end ? high : end;
    first = from > end ? size : static_cast<int>(from);
    first += static_cast<float>(first) < from ? 1 : 0;
    last = to < 0.0f ? -1 : static_cast<int>(to);
  }
  /// Returns the pixels of a tile that are in the interval, one bit each.
  uint32_t in_tile(int tile) const {
    const int before = first - kTilePx * tile, after = kTilePx * tile + kTilePx - 1 - last;
    return 0xffu & (0xffu << (before > 0 ? before : 0)) & (0xffu >> (after > 0 ? after : 0));
  }
};

/// Returns whether all of the given pixels of a tile show a closer surface. @param nearest  max 1 / z of the box, 1/m.
inline bool hides(const Frame& frame, const Tile& tile, uint64_t pixels, float nearest) {
  if ((pixels & ~tile.covered) != 0) return false;
  const Layer* const layer = layers(frame, tile);
  for (uint16_t i = 0; i < tile.count; ++i) {
    if ((layer[i].pixels & pixels) != 0 && !(layer[i].farthest > nearest)) return false;
  }
  return true;
}

/// As Kernels::hides.
inline bool hides(const Frame& frame, const ViewPose& pose, const Box& box, double near_m) {
  const PinholeImage& lens = frame.lens;
  float low_m[3], high_m[3], size_m = 0.0f;  // relative to the camera
  for (int i = 0; i < 3; ++i) {
    low_m[i] = static_cast<float>(static_cast<double>(box.low_m[i]) - pose.p_m[i]);
    high_m[i] = static_cast<float>(static_cast<double>(box.high_m[i]) - pose.p_m[i]);
    const float low = low_m[i] < 0.0f ? -low_m[i] : low_m[i], high = high_m[i] < 0.0f ? -high_m[i] : high_m[i];
    size_m += low > high ? low : high;
  }
  const F8 x = {low_m[0], high_m[0], low_m[0], high_m[0], low_m[0], high_m[0], low_m[0], high_m[0]};
  const F8 y = {low_m[1], low_m[1], high_m[1], high_m[1], low_m[1], low_m[1], high_m[1], high_m[1]};
  const F8 z = {low_m[2], low_m[2], low_m[2], low_m[2], high_m[2], high_m[2], high_m[2], high_m[2]};
  const auto component_C = [&](int row) {
    const double* const r = pose.R_CW + 3 * row;
    return static_cast<float>(r[0]) * x + static_cast<float>(r[1]) * y + static_cast<float>(r[2]) * z;
  };
  const F8 z_C = component_C(2);
  const float nearest_m = range(z_C).min;
  if (nearest_m < static_cast<float>(near_m)) return false;
  // Error bound of the float operations, relative to z.
  const float share = 1e-6f * size_m / nearest_m;
  const float focal_x = static_cast<float>(lens.focal_x_px), focal_y = static_cast<float>(lens.focal_y_px);
  const float sample_px = frame.samples == 1 ? 0.01f : 0.385f;
  const F8 per_z = 1.0f / z_C;
  const auto line = [&](F8 p_C, float focal, double center, int size) {
    const FloatRange bounds = range(p_C * per_z * focal + static_cast<float>(center));
    const float margin = sample_px + share * focal;
    return PixelInterval(bounds.min - margin, bounds.max + margin, size);
  };
  const PixelInterval columns = line(component_C(0), focal_x, lens.center_u_px, lens.width_px);
  const PixelInterval rows = line(component_C(1), focal_y, lens.center_v_px, lens.height_px);
  if (columns.first > columns.last || rows.first > rows.last) return true;
  const float nearest = (1.0f + 1e-5f + share) / nearest_m;
  const size_t grid_tiles = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  for (int row = rows.first / kTilePx; row <= rows.last / kTilePx; ++row) {
    const uint32_t row_bits = rows.in_tile(row);
    const uint64_t row_pixels = kByteMasks.bytes[row_bits];
    const Tile* const tiles = frame.tiles + static_cast<size_t>(row) * static_cast<size_t>(frame.across);
    for (int column = columns.first / kTilePx; column <= columns.last / kTilePx; ++column) {
      const uint64_t pixels = row_pixels & (columns.in_tile(column) * 0x0101010101010101u);
      for (int sample = 0; sample < frame.samples; ++sample) {
        const Tile& tile = tiles[static_cast<size_t>(sample) * grid_tiles + static_cast<size_t>(column)];
        if (!(tile.farthest > nearest) && !hides(frame, tile, pixels, nearest)) return false;
      }
    }
  }
  return true;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
