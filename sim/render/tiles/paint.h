#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/lanes.h"
#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/texture.h"

namespace hedgehop::sim::tiles {
namespace {

/// A value that is affine over the facet's plane, over z. @param at_eye  where the plane's value would be at the eye.
/// @param per_m  its gradient, in the frame of the facet.
inline Affine over_z(double at_eye, const double per_m[3], const Eye& eye, const Affine& w, const Lens& lens) {
  const double* r = eye.R_CW;
  const double x = (r[0] * per_m[0] + r[1] * per_m[1] + r[2] * per_m[2]) * lens.per_focal_x;
  const double y = (r[3] * per_m[0] + r[4] * per_m[1] + r[5] * per_m[2]) * lens.per_focal_y;
  const double z = r[6] * per_m[0] + r[7] * per_m[1] + r[8] * per_m[2];
  return {at_eye * w.right + x, at_eye * w.down + y,
          at_eye * w.at_origin + (z - x * lens.center_u_px - y * lens.center_v_px)};
}

inline Paint paint_of(const SceneView& scene, const Frame& frame, const Surface& surface) {
  const FacetShape& shape = scene.shapes[surface.facet];
  const FacetCover& cover = scene.covers[surface.facet];
  const Eye& eye = frame.eyes[surface.eye];
  const double to_eye[3] = {eye.p_m[0] - shape.x_m[0], eye.p_m[1] - shape.y_m[0], eye.p_m[2] - shape.z_m[0]};
  const auto make = [&](double value, const float per_m[3], double unit) {
    const double scaled[3] = {unit * per_m[0], unit * per_m[1], unit * per_m[2]};
    const double at_eye = unit * value + (scaled[0] * to_eye[0] + scaled[1] * to_eye[1] + scaled[2] * to_eye[2]);
    return over_z(at_eye, scaled, eye, surface.w, frame.lens);
  };
  const double a_repeat = 256.0 * scene.layout.size_px;
  Paint paint{true, make(cover.u, cover.u_per_m, a_repeat), make(cover.v, cover.v_per_m, a_repeat), {}};
  if (!cover.evenly_lit) paint.brightness = make(cover.brightness, cover.brightness_per_m, 1.0);
  return paint;
}

/// The same function in a tile: at its first pixel, and a pixel on.
struct Slope {
  float at_first, right, down;

  F8 row(int row, F8 columns) const { return (at_first + static_cast<float>(row) * down) + columns * right; }
  /// The same at pixels anywhere in the tile.
  F8 at(F8 columns, F8 rows) const { return (at_first + rows * down) + columns * right; }
};

inline Slope slope(const Affine& f, double u, double v) {
  return {static_cast<float>(f.at(u, v)), static_cast<float>(f.right), static_cast<float>(f.down)};
}

/// f - offset w: moves a texture by whole repeats, so that floats of a tile are small.
inline Affine less(const Affine& f, double offset, const Affine& w) {
  return {f.right - offset * w.right, f.down - offset * w.down, f.at_origin - offset * w.at_origin};
}

/// The square of the texels that a pixel spans along the axis where it spans most: d(u/w) = (du - u/w dw) / w.
inline F8 squared_span(const Slope& w, const Slope& u, const Slope& v, F8 at_u, F8 at_v, F8 z) {
  const F8 u_right = u.right - at_u * w.right, v_right = v.right - at_v * w.right;
  const F8 u_down = u.down - at_u * w.down, v_down = v.down - at_v * w.down;
  const F8 texels = z * (1.0f / 256.0f);
  return most(u_right * u_right + v_right * v_right, u_down * u_down + v_down * v_down) * (texels * texels);
}

}  // namespace
}  // namespace hedgehop::sim::tiles
