#pragma once

#include "sim/render/tiles/interpolants.h"
#include "sim/render/tiles/rows.h"

namespace hedgehop::sim::tiles {
namespace {

/// Returns the part of sun_slopes() that all surfaces of an image share.
inline SunView sun_view(const SceneView& scene, const PinholeImage& lens) {
  const auto& f = scene.sun.from_W;
  const auto along = [&](int axis) { return D4{f[0][axis], f[1][axis], f[2][axis], 0.0}; };
  const D4 per_m[3] = {along(0), along(1), along(2)};
  const double* const p = scene.world.p_m;
  SunView view;
  store(per_m[0] * p[0] + per_m[1] * p[1] + per_m[2] * p[2] + along(3), view.at_eye);
  view.in_image = in_image(per_m, scene.world.R_CW, lens);
  return view;
}

/// Returns column, row and depth of the pixels of a tile in the shadow map, each divided by z. The fourth value is
/// unused.
/// @param w  1 / z of the surface. @param u, v  first pixel of the tile.
inline Slopes sun_slopes(const SunView& view, const Affine& w, int u, int v) {
  return slopes(over_z(load(view.at_eye), view.in_image, w), u, v);
}

constexpr float kSunRounding = 1e-5f;  ///< rounding of a depth in the map, towards the sun

/// The share of a surface in a tile that receives sunlight.
enum class Sunlit { none, all, partly };

/// An interval of texel columns or rows of the map with its border, both ends included.
struct SunTexels {
  int first, last;

  /// The texels that are compared for these positions in the map.
  SunTexels(const FloatRange& places, int texels) {
    constexpr float kMargin = 0.05f;  // larger than the rounding of floats
    const auto place = [&](float a) {
      const auto end = static_cast<float>(texels);
      return static_cast<int>((a < -1.0f ? -1.0f : a > end ? end : a) + 1.0f);
    };
    first = place(places.min - kMargin);
    last = place(places.max + kMargin) + 1;
    if (last > texels + 1) last = texels + 1;
  }
  int blocks(int log2) const { return (last >> log2) - (first >> log2) + 1; }
};

/// Returns whether a surface in a tile is lit, from a few blocks of the map. A position is compared with the texels
/// less than one texel away along both axes. @param w, at  of the surface, as in sun_slopes().
inline Sunlit sunlit(const SunDepths& sun, const Slope& w, const Slopes& at) {
  const F8 columns = {0, 7, 0, 7, 0, 7, 0, 7}, rows = {0, 0, 7, 7, 0, 0, 7, 7};  // corners of the tile
  const F8 per_z = w.at(columns, rows);
  if (signs(per_z > 0.0f) != 0xff) return Sunlit::partly;
  const F8 z = 1.0f / per_z;
  const F8 x = at[0].at(columns, rows) * z, y = at[1].at(columns, rows) * z;
  const F8 depth = at[2].at(columns, rows) * z + kSunRounding;
  const SunTexels across(range(x), sun.texels), down(range(y), sun.texels);
  constexpr int kMaxBlocks = 3;  // per side
  int level = 0, log2 = SunBlocks::kFirstLog2;
  for (; across.blocks(log2) > kMaxBlocks || down.blocks(log2) > kMaxBlocks; ++level, ++log2) {
    if (level + 1 == SunBlocks::kLevels) return Sunlit::partly;
  }
  constexpr float kMarginDepth = 4e-6f;  // larger than the rounding of floats
  const float end = static_cast<float>(sun.texels);
  const I8 outside = (minimum(x, y) < -1.0f) | (maximum(x, y) > end);
  float lowest = 1.0f;
  I8 dark{};
  for (int row = down.first >> log2; row <= down.last >> log2; ++row) {
    const SunBlock* const blocks = sun.blocks.levels[level] + row * sun.blocks.across[level];
    for (int column = across.first >> log2; column <= across.last >> log2; ++column) {
      const SunBlock& block = blocks[column];
      lowest = block.min_depth < lowest ? block.min_depth : lowest;
      if (block.right == 0.0f && block.down == 0.0f && block.max_offset <= 0.0f) continue;  // no caster
      const float slope =
          (block.right < 0.0f ? -block.right : block.right) + (block.down < 0.0f ? -block.down : block.down);
      const float margin = kMarginDepth + slope * (1.0f + 1e-6f * static_cast<float>(sun.texels));
      dark |= outside | (depth < block.max_offset + block.right * x + block.down * y + margin);
    }
  }
  if (signs(dark) == 0) return Sunlit::all;
  const bool behind = lowest > 0.0f && range(depth).max + kMarginDepth < lowest;
  return behind ? Sunlit::none : Sunlit::partly;
}

/// Returns the brightness of pixels with their share of sunlight, which is interpolated from four comparisons.
/// @param at  column, row and depth in the shadow map. @tparam F  vector of the pixels.
template <class F>
inline F lit(const SunDepths& sun, const F (&at)[3], F brightness) {
  const F first = F{} - 1.0f, last = F{} + static_cast<float>(sun.texels);
  const auto within = [&](F place) { return maximum(minimum(place, last), first); };
  const F column = within(at[0]), line = within(at[1]);
  const F depth = maximum(at[2] + kSunRounding, F{});
  const auto whole = [&](F a) {
    const auto nearest = integers(a);
    const auto below = nearest + (floats(nearest) > a);  // -1 if it was rounded up
    return minimum(below, decltype(below){} + (sun.texels - 1));
  };
  const auto x = whole(column), y = whole(line);
  const F right = column - floats(x), down = line - floats(y);
  const int stride = sun.texels + 2;
  const auto place = (y + 1) * stride + (x + 1);
  F above[2], below[2];  // left and right
  gather(sun.depths, place, above[0], above[1]);
  gather(sun.depths, place + stride, below[0], below[1]);
  const auto share_of = [&](int side) {
    const auto open = [&](F stored) { return pick(depth >= stored, F{} + 1.0f, F{}); };
    return open(above[side]) + (open(below[side]) - open(above[side])) * down;
  };
  const F left_share = share_of(0), right_share = share_of(1);
  const F share = left_share + (right_share - left_share) * right;
  return sun.ambient + share * (brightness - sun.ambient);
}

/// The same for a tile that is completely lit or completely in shadow.
template <class F>
inline F evenly_lit_by(const SunDepths& sun, Sunlit sunlit, F brightness) {
  return sunlit == Sunlit::all ? sun.ambient + (brightness - sun.ambient) : F{} + sun.ambient;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
