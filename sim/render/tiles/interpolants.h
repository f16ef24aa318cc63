#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/simd.h"

// Values that are interpolated over a surface in a tile: texture coordinates, brightness, depth, planes, labels.

namespace hedgehop::sim::tiles {

namespace {

inline D4 load(const double a[4]) { return D4{a[0], a[1], a[2], a[3]}; }
inline void store(D4 a, double to[4]) { std::memcpy(to, &a, sizeof(a)); }

/// Returns the affine functions of the pixel that gradients in space become on the plane z = 1 of the camera.
/// @param per_m  gradients of four values, in the frame of the camera's pose.
inline Interpolants in_image(const D4 (&per_m)[3], const double R_CW[9], const PinholeImage& lens) {
  const double* const r = R_CW;
  const D4 x = (r[0] * per_m[0] + r[1] * per_m[1] + r[2] * per_m[2]) * lens.per_focal_x;
  const D4 y = (r[3] * per_m[0] + r[4] * per_m[1] + r[5] * per_m[2]) * lens.per_focal_y;
  const D4 z = r[6] * per_m[0] + r[7] * per_m[1] + r[8] * per_m[2];
  Interpolants gradients;
  store(x, gradients.right);
  store(y, gradients.down);
  store(z - x * lens.center_u_px - y * lens.center_v_px, gradients.at_origin);
  return gradients;
}

/// Returns four values that are affine over a plane, each divided by z.
/// @param at_eye  the values extrapolated to the camera position. @param gradients  of in_image(). @param w  1 / z.
inline Interpolants over_z(D4 at_eye, const Interpolants& gradients, const Affine& w) {
  Interpolants interpolants;
  store(at_eye * w.right + load(gradients.right), interpolants.right);
  store(at_eye * w.down + load(gradients.down), interpolants.down);
  store(at_eye * w.at_origin + load(gradients.at_origin), interpolants.at_origin);
  return interpolants;
}

inline Interpolants interpolants_of(const SceneView& scene, const Frame& frame, const Surface& surface) {
  const FacetShape& shape = scene.shapes[surface.facet];
  const ViewPose& pose = frame.poses[surface.pose];
  const double to_eye[3] = {pose.p_m[0] - shape.x_m[0], pose.p_m[1] - shape.y_m[0], pose.p_m[2] - shape.z_m[0]};
  const double repeat = 256.0 * scene.layout.size_px;
  const D4 unit = {repeat, repeat, 1.0, 0.0};
  const float* const values = scene.attributes[surface.facet].values;
  const auto scaled = [&](int first) {
    return unit * D4{values[first], values[first + 1], values[first + 2], values[first + 3]};
  };
  const D4 per_m[3] = {scaled(3), scaled(6), scaled(9)};
  const D4 at_eye = scaled(0) + (per_m[0] * to_eye[0] + per_m[1] * to_eye[1] + per_m[2] * to_eye[2]);
  Interpolants interpolants = over_z(at_eye, in_image(per_m, pose.R_CW, frame.lens), surface.w);
  interpolants.right[3] = surface.w.right;
  interpolants.down[3] = surface.w.down;
  interpolants.at_origin[3] = surface.w.at_origin;
  return interpolants;
}

/// An affine function in a tile: value at the first pixel, change per pixel.
struct Slope {
  float at_first, right, down;

  F8 row(int row, F8 columns) const { return (at_first + static_cast<float>(row) * down) + columns * right; }
  /// Returns the values at arbitrary pixels of the tile.
  template <class F>
  F at(F columns, F rows) const {
    return (rows * down + at_first) + columns * right;
  }
};

inline Slope slope(const Affine& f, double u, double v) {
  return {static_cast<float>(f.at(u, v)), static_cast<float>(f.right), static_cast<float>(f.down)};
}

/// Four affine functions in a tile.
struct Slopes {
  F4 at_first, right, down;

  Slope operator[](int i) const { return {at_first[i], right[i], down[i]}; }
};

inline Slopes slopes(const Interpolants& interpolants, double u, double v) {
  const D4 right = load(interpolants.right), down = load(interpolants.down);
  const auto floats = [](D4 a) { return __builtin_convertvector(a, F4); };
  return {floats(right * u + down * v + load(interpolants.at_origin)), floats(right), floats(down)};
}

/// Shifts the texture coordinates by whole repeats so that they are about 0 at a pixel. Their floats are then small in
/// the whole tile.
inline void shift_texture(double u, double v, double repeat, Interpolants& interpolants) {
  const auto at = [&](int i) {
    return interpolants.right[i] * u + interpolants.down[i] * v + interpolants.at_origin[i];
  };
  const double z = 1.0 / at(3);
  for (int i = 0; i < 2; ++i) {
    const double offset = repeat * __builtin_floor(at(i) * z / repeat);
    interpolants.right[i] -= offset * interpolants.right[3];
    interpolants.down[i] -= offset * interpolants.down[3];
    interpolants.at_origin[i] -= offset * interpolants.at_origin[3];
  }
}

/// Returns the square of the number of texels that a pixel spans, the maximum over both axes: d(u/w) = (du - u/w dw) /
/// w.
/// @param w, u, v  with their change per pixel right and down.
template <class Change>
inline F8 squared_span(const Change& w, const Change& u, const Change& v, F8 at_u, F8 at_v, F8 z) {
  const F8 u_right = u.right - at_u * w.right, v_right = v.right - at_v * w.right;
  const F8 u_down = u.down - at_u * w.down, v_down = v.down - at_v * w.down;
  const F8 texels = z * (1.0f / 256.0f);
  return maximum(u_right * u_right + v_right * v_right, u_down * u_down + v_down * v_down) * (texels * texels);
}

/// Writes the values of the given pixels of a tile. @param of_row  returns the values of a row.
template <class V, class Value, class OfRow>
inline void put_rows(uint64_t pixels, Value (&values)[64], const OfRow& of_row) {
  for (int row = 0; row < kTilePx; ++row) {
    const auto shown = static_cast<int32_t>(pixels >> kTilePx * row & 0xff);
    if (shown == 0) continue;
    if (shown == 0xff) {
      const V all_of_row = of_row(row);
      std::memcpy(values + kTilePx * row, &all_of_row, sizeof(all_of_row));
      continue;
    }
    V kept;
    std::memcpy(&kept, values + kTilePx * row, sizeof(kept));
    const I8 here = (all(shown) & I8{1, 2, 4, 8, 16, 32, 64, 128}) != 0;
    kept = pick(here, of_row(row), kept);
    std::memcpy(values + kTilePx * row, &kept, sizeof(kept));
  }
}

/// z in C, m.
struct DepthMeasure {
  void operator()(const Surface& surface, int u, int v, uint64_t pixels, float (&values)[64]) const {
    const Slope w = slope(surface.w, u, v);
    put_rows<F8>(pixels, values, [&](int row) { return 1.0f / w.row(row, kColumns); });
  }
};

/// Raster::planes.
struct PlaneValue {
  float per_z, right, down, none;
};
struct PlaneMeasure {
  void operator()(const Surface& surface, int u, int v, uint64_t pixels, PlaneValue (&values)[64]) const {
    const Slope w = slope(surface.w, u, v);
    for (; pixels != 0; pixels &= pixels - 1) {
      const int i = __builtin_ctzll(pixels), row = i / kTilePx, column = i % kTilePx;
      const float per_z = (w.at_first + static_cast<float>(row) * w.down) + static_cast<float>(column) * w.right;
      values[i] = {per_z, w.right, w.down, 0.0f};
    }
  }
};

struct LabelMeasure {
  const FacetAttributes* attributes;

  void operator()(const Surface& surface, int, int, uint64_t pixels, int32_t (&values)[64]) const {
    const I8 label = all(attributes[surface.facet].label);
    put_rows<I8>(pixels, values, [&](int) { return label; });
  }
};

}  // namespace

}  // namespace hedgehop::sim::tiles
