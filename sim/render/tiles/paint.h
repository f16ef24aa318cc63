#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/lanes.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {
namespace {

inline D4 load(const double a[4]) { return D4{a[0], a[1], a[2], a[3]}; }
inline void store(D4 a, double to[4]) { std::memcpy(to, &a, sizeof(a)); }

/// Four values that are affine over a plane, over z. @param at_eye  where the plane's values would be at the eye.
/// @param per_m  their gradients, in the frame of the plane.
inline Paint over_z(D4 at_eye, const D4 (&per_m)[3], const double R_CW[9], const Affine& w, const Lens& lens) {
  const double* const r = R_CW;
  const D4 x = (r[0] * per_m[0] + r[1] * per_m[1] + r[2] * per_m[2]) * lens.per_focal_x;
  const D4 y = (r[3] * per_m[0] + r[4] * per_m[1] + r[5] * per_m[2]) * lens.per_focal_y;
  const D4 z = r[6] * per_m[0] + r[7] * per_m[1] + r[8] * per_m[2];
  Paint paint;
  store(at_eye * w.right + x, paint.right);
  store(at_eye * w.down + y, paint.down);
  store(at_eye * w.at_origin + (z - x * lens.center_u_px - y * lens.center_v_px), paint.at_origin);
  return paint;
}

inline Paint paint_of(const SceneView& scene, const Frame& frame, const Surface& surface) {
  const FacetShape& shape = scene.shapes[surface.facet];
  const Eye& eye = frame.eyes[surface.eye];
  const double to_eye[3] = {eye.p_m[0] - shape.x_m[0], eye.p_m[1] - shape.y_m[0], eye.p_m[2] - shape.z_m[0]};
  const double a_repeat = 256.0 * scene.layout.size_px;
  const D4 unit = {a_repeat, a_repeat, 1.0, 0.0};
  const float* const values = scene.covers[surface.facet].values;
  const auto scaled = [&](int first) {
    return unit * D4{values[first], values[first + 1], values[first + 2], values[first + 3]};
  };
  const D4 per_m[3] = {scaled(3), scaled(6), scaled(9)};
  const D4 at_eye = scaled(0) + (per_m[0] * to_eye[0] + per_m[1] * to_eye[1] + per_m[2] * to_eye[2]);
  Paint paint = over_z(at_eye, per_m, eye.R_CW, surface.w, frame.lens);
  paint.right[3] = surface.w.right;
  paint.down[3] = surface.w.down;
  paint.at_origin[3] = surface.w.at_origin;
  return paint;
}

/// An affine function in a tile: at its first pixel, and a pixel on.
struct Slope {
  float at_first, right, down;

  F8 row(int row, F8 columns) const { return (at_first + static_cast<float>(row) * down) + columns * right; }
  /// The same at pixels anywhere in the tile.
  F8 at(F8 columns, F8 rows) const { return (at_first + rows * down) + columns * right; }
};

inline Slope slope(const Affine& f, double u, double v) {
  return {static_cast<float>(f.at(u, v)), static_cast<float>(f.right), static_cast<float>(f.down)};
}

/// Four of them.
struct Slopes {
  F4 at_first, right, down;

  Slope operator[](int i) const { return {at_first[i], right[i], down[i]}; }
};

inline Slopes slopes(const Paint& paint, double u, double v) {
  const D4 right = load(paint.right), down = load(paint.down);
  const auto floats = [](D4 a) { return __builtin_convertvector(a, F4); };
  return {floats(right * u + down * v + load(paint.at_origin)), floats(right), floats(down)};
}

/// Moves a texture by whole repeats, so that it is about 0 at a pixel: floats of a tile are small then.
inline void move_to(double u, double v, double a_repeat, Paint& paint) {
  const auto at = [&](int i) { return paint.right[i] * u + paint.down[i] * v + paint.at_origin[i]; };
  const double z = 1.0 / at(3);
  for (int i = 0; i < 2; ++i) {
    const double offset = a_repeat * __builtin_floor(at(i) * z / a_repeat);
    paint.right[i] -= offset * paint.right[3];
    paint.down[i] -= offset * paint.down[3];
    paint.at_origin[i] -= offset * paint.at_origin[3];
  }
}

/// The square of the texels that a pixel spans along the axis where it spans most: d(u/w) = (du - u/w dw) / w.
/// @param w, u, v  with their changes to the right and down.
template <class Change>
inline F8 squared_span(const Change& w, const Change& u, const Change& v, F8 at_u, F8 at_v, F8 z) {
  const F8 u_right = u.right - at_u * w.right, v_right = v.right - at_v * w.right;
  const F8 u_down = u.down - at_u * w.down, v_down = v.down - at_v * w.down;
  const F8 texels = z * (1.0f / 256.0f);
  return most(u_right * u_right + v_right * v_right, u_down * u_down + v_down * v_down) * (texels * texels);
}

}  // namespace
}  // namespace hedgehop::sim::tiles
