#pragma once

#include <type_traits>

#include "sim/render/tiles/interpolants.h"
#include "sim/render/tiles/sunlight.h"
#include "sim/render/tiles/texture.h"

namespace hedgehop::sim::tiles {
namespace {

/// One byte for each pixel of a tile.
struct TileBytes {
  uint64_t rows[kTilePx];
};

inline uint32_t row_of(uint64_t pixels, int row) { return static_cast<uint32_t>(pixels >> kTilePx * row) & 0xff; }

/// A surface in a tile, prepared for texture lookups.
struct Patch {
  const FacetAttributes* cover;
  Slopes look;  ///< of Interpolants
  Slopes sun;   ///< sun_slopes(), if the sun may light the surface
  int level;    ///< larger of the two texture sizes if equal for all pixels, else -1
  Sunlit sunlit;

  Slope u() const { return look[0]; }
  Slope v() const { return look[1]; }
  Slope brightness() const { return look[2]; }
  Slope w() const { return look[3]; }
};

inline constexpr float kMaxPrecise = 1 << 22;  ///< 1/256 texel: up to here, floats resolve 1/64 texel

/// Returns whether floats resolve 1/64 texel at all corners of the tile, and all corners are in front of the camera.
/// @param level  output: larger of the two texture sizes if equal at all corners, else -1.
inline bool check_corners(const Patch& patch, int last, int& level) {
  const F8 columns = {0, 7, 0, 7, 0, 7, 0, 7}, rows = {0, 0, 7, 7, 0, 0, 7, 7};
  const auto at_corners = [&](const Slope& f) { return f.at_first + columns * f.right + rows * f.down; };
  const F8 w = at_corners(patch.w()), z = 1.0f / w, u = at_corners(patch.u()) * z, v = at_corners(patch.v()) * z;
  const I8 precise = (w > 0.0f) & (maximum(magnitude(u), magnitude(v)) < kMaxPrecise);
  level = -1;
  if (signs(precise) != 0xff) return false;
  const I8 larger = mip_levels(squared_span(patch.w(), patch.u(), patch.v(), u, v, z), last).larger;
  if (signs(larger == larger[0]) == 0xff) level = larger[0];
  return true;
}

/// Returns whether a facet receives no sunlight because it faces away from the sun.
inline bool faces_away_from_sun(const FacetAttributes& cover, const SunDepths& sun) {
  return cover.evenly_lit && cover.brightness() == sun.ambient;
}

inline Patch patch_of(const SceneView& scene, const Frame& frame, uint32_t index, int u, int v) {
  const Surface& surface = frame.surfaces[index];
  Patch patch;
  patch.cover = scene.attributes + surface.facet;
  patch.look = slopes(frame.interpolants[index], u, v);
  patch.level = -1;
  patch.sunlit = Sunlit::none;
  patch.sun = Slopes{};
  if (scene.sun.depths != nullptr && !faces_away_from_sun(*patch.cover, scene.sun)) {
    patch.sunlit = Sunlit::partly;
    patch.sun = sun_slopes(frame.sun, surface.w, u, v);
  }
  return patch;
}

/// The same after shift_texture() to a pixel of the tile.
inline Patch shifted_patch_of(const SceneView& scene, const Frame& frame, uint32_t index, int u, int v, int pixel) {
  shift_texture(u + pixel % kTilePx, v + pixel / kTilePx, 256.0 * scene.layout.size_px, frame.interpolants[index]);
  return patch_of(scene, frame, index, u, v);
}

/// Texture lookups and brightness of several pixels. @tparam F, I  vectors of the pixels.
template <class F, class I>
struct Lookups {
  Taps<I> near, far;  ///< in the larger and the smaller texture size
  F share;            ///< of the smaller
  F light;
  bool mixed;  ///< whether any share is positive
};
using RowLookups = Lookups<FloatRows, IntRows>;

/// Returns the bits of kRows rows.
inline uint32_t rows_of(uint64_t pixels, int first) {
  return static_cast<uint32_t>(pixels >> kTilePx * first) & ((1u << kTilePx * kRows) - 1);
}

/// Finds the texture lookups of a tile. Pairs of rows share the levels of their first row with pixels, as in Mesa's
/// rasterizer.
/// @tparam kCommon  whether the whole tile has one level. @param tile  output: lookups for each kRows rows.
template <int kPlanes, bool kCommon>
inline void find_lookups(const SceneView& scene, const Patch& patch, uint64_t pixels,
                         RowLookups (&tile)[kTilePx / kRows]) {
  using N = std::conditional_t<kCommon, int, IntRows>;
  // Copies, so that the compiler need not reload them after each write.
  const TextureLayout& layout = scene.layout;
  const int last = layout.last_level;
  const Slope slope_w = patch.w(), slope_u = patch.u(), slope_v = patch.v();
  const FloatRows columns = rows_of(kColumns), max_position = rows_of(all(1e9f));
  const FloatRows evenly = rows_of(all(patch.cover->brightness()));
  const bool evenly_lit = patch.cover->evenly_lit, shadows = scene.sun.depths != nullptr;
  LevelLayout<N> near, far;
  if constexpr (kCommon) {
    near = level_layout(layout, patch.level);
    far = level_layout(layout, patch.level < last ? patch.level + 1 : last);
  }
  MipLevels sizes{};
  bool mixed = false;
  int leveled = -1;  // pair of rows of the current sizes
  for (int row = 0; row < kTilePx; row += kRows) {
    const uint32_t shown = rows_of(pixels, row);
    if (shown == 0) continue;
    const FloatRows rows = row_numbers() + static_cast<float>(row);
    const FloatRows z = 1.0f / slope_w.at(columns, rows);
    FloatRows u = slope_u.at(columns, rows) * z, v = slope_v.at(columns, rows) * z;
    if (!kCommon) {  // pixels outside the surface may have any position
      u = maximum(minimum(u, max_position), -max_position), v = maximum(minimum(v, max_position), -max_position);
    }
    if (leveled != row / 2) {
      leveled = row / 2;
      const int first = (shown & 0xff) != 0 ? 0 : 1;
      sizes = mip_levels(squared_span(slope_w, slope_u, slope_v, row_of(u, first), row_of(v, first), row_of(z, first)),
                         last);
      mixed = signs(sizes.share > 0.0f) != 0;
      if constexpr (!kCommon) {
        near = rows_of(level_layout(layout, sizes.larger));
        if (mixed) far = rows_of(level_layout(layout, minimum(sizes.larger + 1, all(last))));
      }
    }
    const TexturePositions<IntRows> at{integers(u), integers(v)};
    RowLookups& out = tile[row / kRows];
    out.share = rows_of(sizes.share);
    out.mixed = mixed;
    out.near = taps<kPlanes>(near, at);
    if (mixed) out.far = taps<kPlanes>(far, at);
    out.light = evenly;
    if (!evenly_lit) out.light = patch.brightness().at(columns, rows) * z;
    if (!shadows) continue;
    if (patch.sunlit == Sunlit::partly) {
      const auto in_map = [&](int i) { return patch.sun[i].at(columns, rows) * z; };
      out.light = lit(scene.sun, {in_map(0), in_map(1), in_map(2)}, out.light);
    } else {
      out.light = evenly_lit_by(scene.sun, patch.sunlit, out.light);
    }
  }
}

/// Returns the levels of pixels. @param texture  position of the first texel of the texture.
template <int kPlanes, class F, class I>
inline void sample_texture(const SceneView& scene, size_t texture, const Lookups<F, I>& where, I (&levels)[kPlanes]) {
  constexpr float kUnit = 1.0f / 65025.0f;
  I near[kPlanes], far[kPlanes];
  fetch(scene.texels, texture, where.near, near);
  if (where.mixed) fetch(scene.texels, texture, where.far, far);
  for (int i = 0; i < kPlanes; ++i) {
    F level = floats(near[i]);
    if (where.mixed) level = level + (floats(far[i]) - level) * where.share;
    levels[i] = integers((level * kUnit + 128.0f) * where.light);
  }
}

/// Shades the given pixels row by row. All lookups are found before the first memory access, so that the accesses
/// overlap.
template <int kPlanes>
inline void shade_rows(const SceneView& scene, const Patch& patch, uint64_t pixels, TileBytes (&out)[kPlanes]) {
  RowLookups tile[kTilePx / kRows];
  if (patch.level >= 0) {
    find_lookups<kPlanes, true>(scene, patch, pixels, tile);
  } else {
    find_lookups<kPlanes, false>(scene, patch, pixels, tile);
  }
  for (int row = 0; row < kTilePx; row += kRows) {
    const uint32_t shown = rows_of(pixels, row);
    if (shown == 0) continue;
    IntRows levels[kPlanes];
    sample_texture(scene, patch.cover->texture * scene.layout.positions, tile[row / kRows], levels);
    for (int i = 0; i < kPlanes; ++i) put_levels(levels[i], shown, out[i].rows + row);
  }
}

/// Shades the pixels of a tile that show a surface. Other pixels are not changed.
/// @param u, v  first pixel of the tile. @param pixels  not 0.
template <int kPlanes>
inline void shade(const SceneView& scene, const Frame& frame, uint32_t surface, int u, int v, uint64_t pixels,
                  TileBytes (&out)[kPlanes]) {
  Patch patch = patch_of(scene, frame, surface, u, v);
  if (!check_corners(patch, scene.layout.last_level, patch.level)) {
    patch = shifted_patch_of(scene, frame, surface, u, v, __builtin_ctzll(pixels));
    check_corners(patch, scene.layout.last_level, patch.level);
  }
  if (patch.sunlit == Sunlit::partly) patch.sunlit = sunlit(scene.sun, patch.w(), patch.sun);
  shade_rows(scene, patch, pixels, out);
}

/// Shades the pixels of a tile that show the sky.
template <int kPlanes>
inline void shade_sky(const SceneView& scene, const PinholeImage& lens, int u, int v, uint64_t pixels,
                      TileBytes (&out)[kPlanes]) {
  const double* r = scene.world.R_CW;
  const auto focal = [](double a) { return static_cast<float>(a); };
  const F8 x = (static_cast<float>(u - lens.center_u_px) + kColumns) * focal(lens.per_focal_x);
  for (int row = 0; row < kTilePx; ++row) {
    const uint32_t shown = row_of(pixels, row);
    if (shown == 0) continue;
    const float y = static_cast<float>(v + row - lens.center_v_px) * focal(lens.per_focal_y);
    const F8 down = static_cast<float>(r[2]) * x + (static_cast<float>(r[5]) * y + static_cast<float>(r[8]));
    const F8 up = maximum(-down, F8{}) / roots(x * x + (y * y + 1.0f));
    const uint64_t here = kByteMasks.bytes[shown];
    for (int i = 0; i < kPlanes; ++i) {
      const F8 level = scene.sky.horizon[i] + up * (scene.sky.zenith[i] - scene.sky.horizon[i]);
      uint64_t& kept = out[i].rows[row];
      kept = (kept & ~here) | (bytes(integers(level)) & here);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
