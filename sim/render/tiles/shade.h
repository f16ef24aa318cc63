#pragma once

#include <type_traits>

#include "sim/render/tiles/paint.h"
#include "sim/render/tiles/sunlight.h"
#include "sim/render/tiles/texture.h"

namespace hedgehop::sim::tiles {
namespace {

/// Bytes of a tile's pixels, a row in each.
struct TileBytes {
  uint64_t rows[kTilePx];
};

inline uint32_t row_of(uint64_t pixels, int row) { return static_cast<uint32_t>(pixels >> kTilePx * row) & 0xff; }

/// A surface in a tile, ready to be looked up.
struct Patch {
  const FacetCover* cover;
  Slopes look;  ///< as in Paint
  Slopes sun;   ///< sun_slopes() where the sun may shine
  int level;    ///< the larger of all its pixels' two, or -1
  Sunlit sunlit;

  Slope u() const { return look[0]; }
  Slope v() const { return look[1]; }
  Slope brightness() const { return look[2]; }
  Slope w() const { return look[3]; }
};

inline constexpr float kFineTo = 1 << 22;  ///< 1/256 texel

/// Sees that floats tell a 64th of a texel: false where the tile's corners lie too far off, or beside the surface.
/// @param level  the larger of the two sizes of the texture that all corners show, or -1.
inline bool look_at_corners(const Patch& patch, int last, int& level) {
  const F8 columns = {0, 7, 0, 7, 0, 7, 0, 7}, rows = {0, 0, 7, 7, 0, 0, 7, 7};
  const auto at_corners = [&](const Slope& f) { return f.at_first + columns * f.right + rows * f.down; };
  const F8 w = at_corners(patch.w()), z = 1.0f / w, u = at_corners(patch.u()) * z, v = at_corners(patch.v()) * z;
  const I8 fine = (w > 0.0f) & (most(magnitude(u), magnitude(v)) < kFineTo);
  level = -1;
  if (signs(fine) != 0xff) return false;
  const I8 larger = levels(squared_span(patch.w(), patch.u(), patch.v(), u, v, z), last).larger;
  if (signs(larger == larger[0]) == 0xff) level = larger[0];
  return true;
}

/// Whether the sun has no part in a facet's light.
inline bool is_averted(const FacetCover& cover, const SunDepths& sun) {
  return cover.evenly_lit && cover.brightness() == sun.ambient;
}

inline Patch patch_of(const SceneView& scene, const Frame& frame, uint32_t index, int u, int v) {
  const Surface& surface = frame.surfaces[index];
  Patch patch;
  patch.cover = scene.covers + surface.facet;
  patch.look = slopes(frame.paints[index], u, v);
  patch.level = -1;
  patch.sunlit = Sunlit::none;
  patch.sun = Slopes{};
  if (scene.sun.depths != nullptr && !is_averted(*patch.cover, scene.sun)) {
    patch.sunlit = Sunlit::partly;
    patch.sun = sun_slopes(scene, frame.lens, surface.w, u, v);
  }
  return patch;
}

/// The same with the texture moved to be about 0 at one of the tile's pixels.
inline Patch moved_patch_of(const SceneView& scene, const Frame& frame, uint32_t index, int u, int v, int pixel) {
  move_to(u + pixel % kTilePx, v + pixel / kTilePx, 256.0 * scene.layout.size_px, frame.paints[index]);
  return patch_of(scene, frame, index, u, v);
}

/// How a row's pixels look up the texture, and how bright they are.
struct RowTaps {
  Taps near, far;  ///< in the larger and in the smaller size
  F8 share;        ///< of the smaller
  F8 light;
  bool mixed;  ///< whether any share is above 0
};

/// @tparam kCommon  whether the tile has one level. Two rows share their levels, as in Mesa's rasteriser.
template <int kPlanes, bool kCommon>
inline void look_where(const SceneView& scene, const Patch& patch, uint64_t pixels, RowTaps (&rows)[kTilePx]) {
  using N = std::conditional_t<kCommon, int, I8>;
  // Copies, which no row that is written can change.
  const TextureLayout& layout = scene.layout;
  const int last = layout.last_level;
  const Slope slope_w = patch.w(), slope_u = patch.u(), slope_v = patch.v();
  const F8 far_off = all(1e9f), evenly = all(patch.cover->brightness());
  const bool evenly_lit = patch.cover->evenly_lit, shadows = scene.sun.depths != nullptr;
  LevelPlaces<N> near, far;
  if constexpr (kCommon) {
    near = level_places(layout, patch.level);
    far = level_places(layout, patch.level < last ? patch.level + 1 : last);
  }
  Levels sizes{};
  bool mixed = false;
  int leveled = -1;  // the pair of rows that the sizes are of
  for (int row = 0; row < kTilePx; ++row) {
    if (row_of(pixels, row) == 0) continue;
    const F8 z = 1.0f / slope_w.row(row, kColumns);
    F8 u = slope_u.row(row, kColumns) * z, v = slope_v.row(row, kColumns) * z;
    if (!kCommon) {  // pixels beside the surface may lie anywhere
      u = most(least(u, far_off), -far_off), v = most(least(v, far_off), -far_off);
    }
    if (leveled != row / 2) {
      leveled = row / 2;
      sizes = levels(squared_span(slope_w, slope_u, slope_v, u, v, z), last);
      mixed = signs(sizes.share > 0.0f) != 0;
      if constexpr (!kCommon) {
        near = level_places(layout, sizes.larger);
        if (mixed) far = level_places(layout, least(sizes.larger + 1, all(last)));
      }
    }
    const Places at{integers(u), integers(v)};
    RowTaps& out = rows[row];
    out.share = sizes.share;
    out.mixed = mixed;
    out.near = taps<kPlanes>(near, at);
    if (mixed) out.far = taps<kPlanes>(far, at);
    out.light = evenly;
    if (!evenly_lit) out.light = patch.brightness().row(row, kColumns) * z;
    if (!shadows) continue;
    if (patch.sunlit == Sunlit::partly) {
      const auto in_map = [&](int i) { return patch.sun[i].row(row, kColumns) * z; };
      out.light = lit(scene.sun, {in_map(0), in_map(1), in_map(2)}, out.light);
    } else {
      out.light = evenly_lit_by(scene.sun, patch.sunlit, out.light);
    }
  }
}

/// Levels of eight pixels, 0..255. @param texture  place of its first texel.
template <int kPlanes>
inline void look_up(const SceneView& scene, size_t texture, const RowTaps& where, uint64_t (&levels)[kPlanes]) {
  constexpr float kUnit = 1.0f / 65025.0f;
  I8 near[kPlanes], far[kPlanes];
  fetch(scene.texels, texture, where.near, near);
  if (where.mixed) fetch(scene.texels, texture, where.far, far);
  for (int i = 0; i < kPlanes; ++i) {
    F8 level = floats(near[i]);
    if (where.mixed) level += (floats(far[i]) - level) * where.share;
    levels[i] = bytes(integers((level * kUnit + 128.0f) * where.light));
  }
}

/// Shades pixels row by row, the others are left. All places are found before any is looked up: memory is waited for
/// once.
template <int kPlanes>
inline void shade_rows(const SceneView& scene, const Patch& patch, uint64_t pixels, TileBytes (&out)[kPlanes]) {
  RowTaps rows[kTilePx];
  if (patch.level >= 0) {
    look_where<kPlanes, true>(scene, patch, pixels, rows);
  } else {
    look_where<kPlanes, false>(scene, patch, pixels, rows);
  }
  for (int row = 0; row < kTilePx; ++row) {
    const uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    const uint64_t here = kSpread.bytes[shown];
    uint64_t levels[kPlanes];
    look_up(scene, patch.cover->texture * scene.layout.places, rows[row], levels);
    for (int i = 0; i < kPlanes; ++i) out[i].rows[row] = (out[i].rows[row] & ~here) | (levels[i] & here);
  }
}

/// Shades the pixels of a tile that show a surface; leaves the others.
/// @param u, v  the tile's first pixel. @param pixels  not 0.
template <int kPlanes>
inline void shade(const SceneView& scene, const Frame& frame, uint32_t surface, int u, int v, uint64_t pixels,
                  TileBytes (&out)[kPlanes]) {
  Patch patch = patch_of(scene, frame, surface, u, v);
  if (!look_at_corners(patch, scene.layout.last_level, patch.level)) {
    patch = moved_patch_of(scene, frame, surface, u, v, __builtin_ctzll(pixels));
    look_at_corners(patch, scene.layout.last_level, patch.level);
  }
  if (patch.sunlit == Sunlit::partly) patch.sunlit = sunlit(scene.sun, patch.w(), patch.sun);
  shade_rows(scene, patch, pixels, out);
}

/// Shades the pixels of a tile that show the sky.
template <int kPlanes>
inline void shade_sky(const SceneView& scene, const Lens& lens, int u, int v, uint64_t pixels,
                      TileBytes (&out)[kPlanes]) {
  const double* r = scene.world.R_CW;
  const auto focal = [](double a) { return static_cast<float>(a); };
  const F8 x = (static_cast<float>(u - lens.center_u_px) + kColumns) * focal(lens.per_focal_x);
  for (int row = 0; row < kTilePx; ++row) {
    const uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    const float y = static_cast<float>(v + row - lens.center_v_px) * focal(lens.per_focal_y);
    const F8 down = static_cast<float>(r[2]) * x + (static_cast<float>(r[5]) * y + static_cast<float>(r[8]));
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
