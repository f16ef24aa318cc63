#pragma once

#include "sim/render/tiles/finish.h"

// Displacement of the point of each pixel until the next image.
namespace hedgehop::sim::tiles {
namespace {

/// The position in the next image times z there, relative to the first pixel of the tile, and z there. All are divided
/// by the current z and thus affine in the pixel.
struct NextSlopes {
  Slope u, v, z;
};

/// @param next  of the frame of the surface. @param w  current 1 / z of the surface, 0 for the sky.
inline NextSlopes next_slopes(const PinholeImage& lens, const NextPose& next, const Affine& w, int u, int v) {
  const double* const p_CnC_m = next.p_CnC_m;
  const auto along = [&](int axis) -> Affine {
    const double* const r = next.R_CnC + 3 * axis;
    const double right = r[0] * lens.per_focal_x, down = r[1] * lens.per_focal_y;
    return {right + p_CnC_m[axis] * w.right, down + p_CnC_m[axis] * w.down,
            r[2] - right * lens.center_u_px - down * lens.center_v_px + p_CnC_m[axis] * w.at_origin};
  };
  const auto sum = [](double a, const Affine& f, double b, const Affine& g) -> Affine {
    return {a * f.right + b * g.right, a * f.down + b * g.down, a * f.at_origin + b * g.at_origin};
  };
  const Affine x = along(0), y = along(1), z = along(2);
  return {slope(sum(lens.focal_x_px, x, lens.center_u_px - u, z), u, v),
          slope(sum(lens.focal_y_px, y, lens.center_v_px - v, z), u, v), slope(z, u, v)};
}

struct FlowValue {
  float right, down;
};

inline void write_flow(const NextSlopes& next, uint64_t pixels, FlowValue (&values)[64]) {
  for (int row = 0; row < kTilePx; ++row) {
    uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    const F8 z = next.z.row(row, kColumns), per_z = 1.0f / z;
    const I8 ahead = z > 0.0f;
    const F8 unknown = all(__builtin_nanf(""));
    const F8 right = pick(ahead, next.u.row(row, kColumns) * per_z - kColumns, unknown);
    const F8 down = pick(ahead, next.v.row(row, kColumns) * per_z - static_cast<float>(row), unknown);
    FlowValue* const first = values + kTilePx * row;
    if (shown == 0xff) {
      const F8 left_half = __builtin_shufflevector(right, down, 0, 8, 1, 9, 2, 10, 3, 11);
      const F8 right_half = __builtin_shufflevector(right, down, 4, 12, 5, 13, 6, 14, 7, 15);
      std::memcpy(first, &left_half, sizeof(left_half));
      std::memcpy(first + 4, &right_half, sizeof(right_half));
      continue;
    }
    for (; shown != 0; shown &= shown - 1) {
      const int i = __builtin_ctz(shown);
      first[i] = {right[i], down[i]};
    }
  }
}

/// As Kernels::flow.
inline void flow(const Frame& frame, const NextPose* next, const ImageMemory& image) {
  for (int row = 0; row < frame.down; ++row) {
    for (int column = 0; column < frame.across; ++column) {
      const int u = kTilePx * column, v = kTilePx * row;
      FlowValue values[kTilePx * kTilePx];
      const TileLayers tile = layers_at(frame, column, row, 0);
      uint64_t sky = ~uint64_t{0};
      for (uint16_t i = 0; i < tile.count; ++i) {
        const Surface& surface = frame.surfaces[tile.layers[i].surface];
        sky &= ~tile.layers[i].pixels;
        write_flow(next_slopes(frame.lens, next[surface.pose], surface.w, u, v), tile.layers[i].pixels, values);
      }
      if (sky != 0) write_flow(next_slopes(frame.lens, next[0], {}, u, v), sky, values);
      write_values(values, window_of(frame, image, column, row, sizeof(FlowValue)), image.step);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
