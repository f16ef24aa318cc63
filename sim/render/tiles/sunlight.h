#pragma once

#include "sim/render/tiles/paint.h"

namespace hedgehop::sim::tiles {
namespace {

/// Column, row and depth of a tile's pixels in the sun's map, over z. The fourth is of no meaning.
/// @param w  1 / z of the surface. @param u, v  the tile's first pixel.
inline Slopes sun_slopes(const SceneView& scene, const Lens& lens, const Affine& w, int u, int v) {
  const auto& f = scene.sun.from_W;
  const auto along = [&](int axis) { return D4{f[0][axis], f[1][axis], f[2][axis], 0.0}; };
  const D4 per_m[3] = {along(0), along(1), along(2)};
  const double* const p = scene.world.p_m;
  const D4 at_eye = per_m[0] * p[0] + per_m[1] * p[1] + per_m[2] * p[2] + along(3);
  return slopes(over_z(at_eye, per_m, scene.world.R_CW, w, lens), u, v);
}

/// Brightness of pixels of a tile, the sun's part of it as much as reaches them: four comparisons, mixed.
/// @param at  column, row and depth in the sun's map.
inline F8 lit(const SunDepths& sun, const F8 (&at)[3], F8 brightness) {
  const float last = static_cast<float>(sun.texels);
  const auto within = [&](F8 place) { return most(least(place, all(last)), all(-1.0f)); };
  const F8 column = within(at[0]), line = within(at[1]);
  constexpr float kRounding = 1e-5f;
  const F8 depth = most(at[2] + kRounding, F8{});
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
