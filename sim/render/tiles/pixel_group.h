#pragma once

#include "sim/render/tiles/shade.h"

// Shades surfaces with few pixels in a tile together, one lane per pixel.
namespace hedgehop::sim::tiles {
namespace {

inline constexpr int kGroupSize = 8;

/// Up to eight pixels of a tile, of one or several surfaces.
struct PixelGroup {
  int count = 0, layer_count = 0;
  struct SurfacePixels {
    uint32_t surface;
    uint64_t pixels;
  } layers[kGroupSize];
  uint8_t index[kGroupSize];  ///< index of each pixel in the tile
  int32_t texture[kGroupSize];
  float even[kGroupSize];  ///< brightness if it is constant, else NaN
  Slopes look[kGroupSize], sun[kGroupSize];

  void add(const SceneView& scene, const Patch& patch, uint32_t surface, uint64_t pixels) {
    layers[layer_count++] = {surface, pixels};
    for (; pixels != 0; pixels &= pixels - 1) put(scene, patch, static_cast<uint8_t>(__builtin_ctzll(pixels)));
  }
  void put(const SceneView& scene, const Patch& patch, uint8_t pixel) {
    index[count] = pixel;
    texture[count] = static_cast<int32_t>(patch.cover->texture * scene.layout.positions);
    even[count] = patch.cover->evenly_lit ? patch.cover->brightness() : __builtin_nanf("");
    look[count] = patch.look;
    if (scene.sun.depths != nullptr) sun[count] = patch.sun;
    ++count;
  }
  /// Fills the unused lanes with the first pixel.
  void fill(bool shadows) {
    for (int i = count; i < kGroupSize; ++i) {
      index[i] = index[0];
      texture[i] = texture[0];
      even[i] = even[0];
      look[i] = look[0];
      if (shadows) sun[i] = sun[0];
    }
  }
};

/// Four affine functions per lane: value at the pixel of the lane, change per pixel right and down.
struct LaneSlopes {
  F8 at[4], right[4], down[4];

  LaneSlopes(const Slopes (&lanes)[kGroupSize], F8 columns, F8 rows) {
    F8 at_first[4];
    columns_of(lanes, &Slopes::at_first, at_first);
    columns_of(lanes, &Slopes::right, right);
    columns_of(lanes, &Slopes::down, down);
    for (int i = 0; i < 4; ++i) at[i] = (at_first[i] + rows * down[i]) + columns * right[i];
  }
  struct PixelChange {
    F8 right, down;
  };
  PixelChange change(int i) const { return {right[i], down[i]}; }
};

/// Finds the texture lookups of the pixels. Returns false if floats do not resolve 1/64 texel.
template <int kPlanes>
inline bool find_lookups(const SceneView& scene, PixelGroup& group, Lookups<F8, I8>& out) {
  const int last = scene.layout.last_level;
  const bool shadows = scene.sun.depths != nullptr;
  group.fill(shadows);
  const I8 places = {group.index[0], group.index[1], group.index[2], group.index[3],
                     group.index[4], group.index[5], group.index[6], group.index[7]};
  const F8 columns = floats(places & 7), rows = floats(places >> 3);
  const LaneSlopes look(group.look, columns, rows);
  const F8 z = 1.0f / look.at[3], u = look.at[0] * z, v = look.at[1] * z;
  if (signs(maximum(magnitude(u), magnitude(v)) < kMaxPrecise) != 0xff) return false;
  const TexturePositions<I8> at{integers(u), integers(v)};
  const MipLevels sizes = mip_levels(squared_span(look.change(3), look.change(0), look.change(1), u, v, z), last);
  I8 texture;
  std::memcpy(&texture, group.texture, sizeof(texture));
  const auto taps_in = [&](I8 level) {
    Taps<I8> found = taps<kPlanes>(level_layout(scene.layout, level), at);
    found.place += texture;
    if (kPlanes > 1) found.below += texture;
    return found;
  };
  out.share = sizes.share;
  out.mixed = signs(sizes.share > 0.0f) != 0;
  out.near = taps_in(sizes.larger);
  if (out.mixed) out.far = taps_in(minimum(sizes.larger + 1, all(last)));
  F8 even;
  std::memcpy(&even, group.even, sizeof(even));
  out.light = pick(even == even, even, look.at[2] * z);
  if (shadows) {
    const LaneSlopes sun(group.sun, columns, rows);
    out.light = lit(scene.sun, {sun.at[0] * z, sun.at[1] * z, sun.at[2] * z}, out.light);
  }
  return true;
}

template <int kPlanes>
inline void put_group(const SceneView& scene, const PixelGroup& group, const Lookups<F8, I8>& where,
                      TileBytes (&out)[kPlanes]) {
  I8 levels[kPlanes];
  sample_texture(scene, 0, where, levels);
  for (int i = 0; i < kPlanes; ++i) {
    uint8_t* const tile = reinterpret_cast<uint8_t*>(out[i].rows);
    uint64_t pixels = bytes(levels[i]);
    for (int k = 0; k < group.count; ++k, pixels >>= 8) tile[group.index[k]] = static_cast<uint8_t>(pixels);
  }
}

/// Shades the pixels of one surface of a group, if necessary after shift_texture().
template <int kPlanes>
inline void shade_shifted(const SceneView& scene, const Frame& frame, const PixelGroup::SurfacePixels& layer, int u,
                          int v, TileBytes (&out)[kPlanes]) {
  const int any = __builtin_ctzll(layer.pixels);
  Lookups<F8, I8> where{};
  for (int shifted = 0; shifted < 2; ++shifted) {
    const Patch patch = shifted ? shifted_patch_of(scene, frame, layer.surface, u, v, any)
                                : patch_of(scene, frame, layer.surface, u, v);
    PixelGroup group;
    group.add(scene, patch, layer.surface, layer.pixels);
    if (find_lookups<kPlanes>(scene, group, where)) return put_group(scene, group, where, out);
    if (shifted == 1) shade_rows(scene, patch, layer.pixels, out);
  }
}

/// Shades the pixels of the group and empties it. @param u, v  first pixel of the tile.
template <int kPlanes>
inline void shade_group(const SceneView& scene, const Frame& frame, int u, int v, PixelGroup& group,
                        TileBytes (&out)[kPlanes]) {
  Lookups<F8, I8> where{};
  if (find_lookups<kPlanes>(scene, group, where)) {
    put_group(scene, group, where, out);
  } else {
    for (int i = 0; i < group.layer_count; ++i) shade_shifted(scene, frame, group.layers[i], u, v, out);
  }
  group.count = group.layer_count = 0;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
