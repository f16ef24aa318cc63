#pragma once

#include "sim/render/tiles/paint.h"
#include "sim/render/tiles/sunlight.h"

namespace hedgehop::sim::tiles {
namespace {

/// Bytes of a tile's pixels, a row in each.
struct TileBytes {
  uint64_t rows[kTilePx];
};

/// A byte of ones for each bit.
struct Spread {
  uint64_t bytes[256] = {};
  constexpr Spread() {
    for (int bits = 0; bits < 256; ++bits) {
      for (int i = 0; i < 8; ++i) bytes[bits] |= (bits >> i & 1) != 0 ? uint64_t{0xff} << 8 * i : 0;
    }
  }
};
inline constexpr Spread kSpread;

inline uint32_t row_of(uint64_t pixels, int row) { return static_cast<uint32_t>(pixels >> kTilePx * row) & 0xff; }

/// A surface in a tile, ready to be looked up.
struct Patch {
  Slope w, u, v, brightness;
  const FacetCover* cover;
  SunSlopes sun;
  int level;  ///< the larger of all its pixels' two, or -1
};

/// The larger of the two sizes of the texture that all of the tile shows, if its corners agree on it.
inline int common_level(const Patch& patch, int last) {
  const F8 columns = {0, 7, 0, 7, 0, 7, 0, 7}, rows = {0, 0, 7, 7, 0, 0, 7, 7};
  const auto at_corners = [&](const Slope& f) { return f.at_first + columns * f.right + rows * f.down; };
  const F8 w = at_corners(patch.w);
  constexpr float kNowhereNear = 1e-9f, kFarOff = 1e9f;
  if (signs(w > kNowhereNear) != 0xff) return -1;
  const F8 z = 1.0f / w, u = at_corners(patch.u) * z, v = at_corners(patch.v) * z;
  if (signs(most(magnitude(u), magnitude(v)) < kFarOff) != 0xff) return -1;
  const Levels found = levels(squared_span(patch.w, patch.u, patch.v, u, v, z), last);
  const int level = found.larger[0];
  return signs(found.larger == level) == 0xff ? level : -1;
}

/// @param u, v  the tile's first pixel. @param pixels  of it that show the surface, not 0.
inline Patch patch_of(const SceneView& scene, const Frame& frame, const Surface& surface, const Paint& paint, int u,
                      int v, uint64_t pixels) {
  const int any = __builtin_ctzll(pixels);
  const double some_u = u + any % kTilePx, some_v = v + any / kTilePx, z = 1.0 / surface.w.at(some_u, some_v);
  const double a_repeat = 256.0 * scene.layout.size_px;
  const auto repeats = [&](const Affine& f) { return a_repeat * __builtin_floor(f.at(some_u, some_v) * z / a_repeat); };
  Patch patch;
  patch.w = slope(surface.w, u, v);
  patch.u = slope(less(paint.u, repeats(paint.u), surface.w), u, v);
  patch.v = slope(less(paint.v, repeats(paint.v), surface.w), u, v);
  patch.brightness = slope(paint.brightness, u, v);
  patch.cover = scene.covers + surface.facet;
  if (scene.sun.depths != nullptr) patch.sun = sun_slopes(scene, frame.lens, surface.w, u, v);
  patch.level = common_level(patch, scene.layout.last_level);
  return patch;
}

/// Levels, 0..255, of a row's pixels in each of the planes.
template <int kPlanes>
inline void shade_row(const SceneView& scene, const Patch& patch, int row, I8 (&out)[kPlanes]) {
  const TextureLayout& layout = scene.layout;
  const F8 z = 1.0f / patch.w.row(row, kColumns);
  F8 u = patch.u.row(row, kColumns) * z, v = patch.v.row(row, kColumns) * z;
  F8 light = all(static_cast<float>(patch.cover->brightness));
  if (!patch.cover->evenly_lit) light = patch.brightness.row(row, kColumns) * z;
  if (scene.sun.depths != nullptr) light = lit(scene.sun, patch.sun, row, z, light);

  const bool common = patch.level >= 0;
  if (!common) {  // pixels beside the surface may lie anywhere
    const F8 far_off = all(1e9f);
    u = most(least(u, far_off), -far_off), v = most(least(v, far_off), -far_off);
  }
  const Places at{integers(u), integers(v)};
  const Levels sizes = levels(squared_span(patch.w, patch.u, patch.v, u, v, z), layout.last_level);
  const bool mixed = signs(sizes.share > 0.0f) != 0;
  const Taps near = common ? taps(layout, at, patch.level) : taps(layout, at, sizes.larger);
  Taps far{};
  if (mixed) {
    far = common ? taps(layout, at, patch.level + 1) : taps(layout, at, least(sizes.larger + 1, all(layout.last_level)));
  }
  const size_t texture = patch.cover->texture * layout.places;
  constexpr float kUnit = 1.0f / 65025.0f;
  for (int i = 0; i < kPlanes; ++i) {
    const uint16_t* const places = scene.planes[i].places + texture;
    F8 level = floats(fetch(places, near));
    if (mixed) level += (floats(fetch(places, far)) - level) * sizes.share;
    out[i] = integers((level * kUnit + 128.0f) * light);
  }
}

/// Shades the pixels of a tile that show a surface; leaves the others.
template <int kPlanes>
inline void shade(const SceneView& scene, const Patch& patch, uint64_t pixels, TileBytes (&out)[kPlanes]) {
  for (int row = 0; row < kTilePx; ++row) {
    const uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    I8 levels[kPlanes];
    shade_row(scene, patch, row, levels);
    const uint64_t here = kSpread.bytes[shown];
    for (int i = 0; i < kPlanes; ++i) {
      uint64_t& kept = out[i].rows[row];
      kept = (kept & ~here) | (bytes(levels[i]) & here);
    }
  }
}

/// Shades the pixels of a tile that show the sky.
template <int kPlanes>
inline void shade_sky(const SceneView& scene, const Lens& lens, int u, int v, uint64_t pixels,
                      TileBytes (&out)[kPlanes]) {
  const double* r = scene.R_WC;
  const auto focal = [](double a) { return static_cast<float>(a); };
  const F8 x = (static_cast<float>(u - lens.center_u_px) + kColumns) * focal(lens.per_focal_x);
  for (int row = 0; row < kTilePx; ++row) {
    const uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    const float y = static_cast<float>(v + row - lens.center_v_px) * focal(lens.per_focal_y);
    const F8 down = static_cast<float>(r[6]) * x + (static_cast<float>(r[7]) * y + static_cast<float>(r[8]));
    const F8 up = most(-down, F8{}) / roots(x * x + (y * y + 1.0f));
    const uint64_t here = kSpread.bytes[shown];
    for (int i = 0; i < kPlanes; ++i) {
      const F8 level = scene.sky.horizon[i] + up * (scene.sky.zenith[i] - scene.sky.horizon[i]);
      uint64_t& kept = out[i].rows[row];
      kept = (kept & ~here) | (bytes(integers(level)) & here);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
