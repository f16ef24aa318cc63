#pragma once

#include "sim/render/tiles/paint.h"

namespace hedgehop::sim::tiles {
namespace {

/// Column, row and depth of a tile's pixels in the sun's map, over z.
struct SunSlopes {
  Slope column, row, depth;
};

/// @param w  1 / z of the surface. @param u, v  the tile's first pixel.
inline SunSlopes sun_slopes(const SceneView& scene, const Lens& lens, const Affine& w, int u, int v) {
  const auto make = [&](const double f[4]) {
    const double* r = scene.R_WC;
    const double at_eye = f[0] * scene.p_WC[0] + f[1] * scene.p_WC[1] + f[2] * scene.p_WC[2] + f[3];
    const double x = (f[0] * r[0] + f[1] * r[3] + f[2] * r[6]) * lens.per_focal_x;
    const double y = (f[0] * r[1] + f[1] * r[4] + f[2] * r[7]) * lens.per_focal_y;
    const double z = f[0] * r[2] + f[1] * r[5] + f[2] * r[8];
    return slope({at_eye * w.right + x, at_eye * w.down + y,
                  at_eye * w.at_origin + (z - x * lens.center_u_px - y * lens.center_v_px)},
                 u, v);
  };
  return {make(scene.sun.from_W[0]), make(scene.sun.from_W[1]), make(scene.sun.from_W[2])};
}

/// Brightness of pixels of a tile, the sun's part of it as much as reaches them: four comparisons, mixed.
inline F8 lit(const SunDepths& sun, const SunSlopes& at, F8 columns, F8 rows, F8 z, F8 brightness) {
  const float last = static_cast<float>(sun.texels);
  const auto within = [&](F8 place) { return most(least(place, all(last)), all(-1.0f)); };
  const F8 column = within(at.column.at(columns, rows) * z), line = within(at.row.at(columns, rows) * z);
  constexpr float kRounding = 1e-5f;
  const F8 depth = most(at.depth.at(columns, rows) * z + kRounding, F8{});
  const auto whole = [](F8 a) {
    const I8 nearest = integers(a);
    return nearest + (floats(nearest) > a);  // -1 where it was rounded up
  };
  const I8 x = least(whole(column), all(sun.texels - 1)), y = least(whole(line), all(sun.texels - 1));
  const F8 right = column - floats(x), down = line - floats(y);
  const int stride = sun.texels + 2;
  const I8 place = (y + 1) * stride + (x + 1);
  const auto open = [&](I8 where) { return pick(depth >= gather(sun.depths, where), all(1.0f), F8{}); };
  const F8 left_share = open(place) + (open(place + stride) - open(place)) * down;
  const F8 right_share = open(place + 1) + (open(place + (stride + 1)) - open(place + 1)) * down;
  const F8 share = left_share + (right_share - left_share) * right;
  return sun.ambient + share * (brightness - sun.ambient);
}

}  // namespace
}  // namespace hedgehop::sim::tiles
