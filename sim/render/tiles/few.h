#pragma once

#include "sim/render/tiles/shade.h"

// Shades surfaces that show in few pixels of a tile together, a lane for each pixel.
namespace hedgehop::sim::tiles {
namespace {

inline constexpr int kFew = 8;

/// Up to eight pixels of a tile, of one surface or of several.
struct Handful {
  int count = 0, layer_count = 0;
  struct Part {
    uint32_t surface;
    uint64_t pixels;
  } layers[kFew];
  uint8_t index[kFew];  ///< of each pixel in the tile
  int32_t texture[kFew];
  float even[kFew];  ///< brightness where it is, else NaN
  Slopes look[kFew], sun[kFew];

  void add(const SceneView& scene, const Patch& patch, uint32_t surface, uint64_t pixels) {
    layers[layer_count++] = {surface, pixels};
    for (; pixels != 0; pixels &= pixels - 1) put(scene, patch, static_cast<uint8_t>(__builtin_ctzll(pixels)));
  }
  void put(const SceneView& scene, const Patch& patch, uint8_t pixel) {
    index[count] = pixel;
    texture[count] = static_cast<int32_t>(patch.cover->texture * scene.layout.places);
    even[count] = patch.cover->evenly_lit ? patch.cover->brightness() : __builtin_nanf("");
    look[count] = patch.look;
    if (scene.sun.depths != nullptr) sun[count] = patch.sun;
    ++count;
  }
  /// Lets the lanes that are left show the first pixel once more.
  void fill(bool shadows) {
    for (int i = count; i < kFew; ++i) {
      index[i] = index[0];
      texture[i] = texture[0];
      even[i] = even[0];
      look[i] = look[0];
      if (shadows) sun[i] = sun[0];
    }
  }
};

/// Four affine functions of each lane, at its pixel and how they change to the right and down.
struct LaneSlopes {
  F8 at[4], right[4], down[4];

  LaneSlopes(const Slopes (&lanes)[kFew], F8 columns, F8 rows) {
    F8 at_first[4];
    columns_of(lanes, &Slopes::at_first, at_first);
    columns_of(lanes, &Slopes::right, right);
    columns_of(lanes, &Slopes::down, down);
    for (int i = 0; i < 4; ++i) at[i] = (at_first[i] + rows * down[i]) + columns * right[i];
  }
  struct Change {
    F8 right, down;
  };
  Change change(int i) const { return {right[i], down[i]}; }
};

/// Finds where the pixels look their textures up. @return false where floats do not tell a 64th of a texel.
template <int kPlanes>
inline bool look_where(const SceneView& scene, Handful& few, RowTaps& out) {
  const int last = scene.layout.last_level;
  const bool shadows = scene.sun.depths != nullptr;
  few.fill(shadows);
  const I8 places = {few.index[0], few.index[1], few.index[2], few.index[3],
                     few.index[4], few.index[5], few.index[6], few.index[7]};
  const F8 columns = floats(places & 7), rows = floats(places >> 3);
  const LaneSlopes look(few.look, columns, rows);
  const F8 z = 1.0f / look.at[3], u = look.at[0] * z, v = look.at[1] * z;
  if (signs(most(magnitude(u), magnitude(v)) < kFineTo) != 0xff) return false;
  const Places at{integers(u), integers(v)};
  const Levels sizes = levels(squared_span(look.change(3), look.change(0), look.change(1), u, v, z), last);
  I8 texture;
  std::memcpy(&texture, few.texture, sizeof(texture));
  const auto taps_in = [&](I8 level) {
    Taps found = taps<kPlanes>(level_places(scene.layout, level), at);
    found.place += texture;
    if (kPlanes > 1) found.below += texture;
    return found;
  };
  out.share = sizes.share;
  out.mixed = signs(sizes.share > 0.0f) != 0;
  out.near = taps_in(sizes.larger);
  if (out.mixed) out.far = taps_in(least(sizes.larger + 1, all(last)));
  F8 even;
  std::memcpy(&even, few.even, sizeof(even));
  out.light = pick(even == even, even, look.at[2] * z);
  if (shadows) {
    const LaneSlopes sun(few.sun, columns, rows);
    out.light = lit(scene.sun, {sun.at[0] * z, sun.at[1] * z, sun.at[2] * z}, out.light);
  }
  return true;
}

template <int kPlanes>
inline void put_few(const SceneView& scene, const Handful& few, const RowTaps& where, TileBytes (&out)[kPlanes]) {
  uint64_t levels[kPlanes];
  look_up(scene, 0, where, levels);
  for (int i = 0; i < kPlanes; ++i) {
    uint8_t* const bytes = reinterpret_cast<uint8_t*>(out[i].rows);
    for (int k = 0; k < few.count; ++k, levels[i] >>= 8) bytes[few.index[k]] = static_cast<uint8_t>(levels[i]);
  }
}

/// Shades the few pixels of one surface whose texture has to be moved.
template <int kPlanes>
inline void shade_moved(const SceneView& scene, const Frame& frame, const Handful::Part& layer, int u, int v,
                        TileBytes (&out)[kPlanes]) {
  const int any = __builtin_ctzll(layer.pixels);
  RowTaps where{};
  for (int moved = 0; moved < 2; ++moved) {
    const Patch patch =
        moved ? moved_patch_of(scene, frame, layer.surface, u, v, any) : patch_of(scene, frame, layer.surface, u, v);
    Handful few;
    few.add(scene, patch, layer.surface, layer.pixels);
    if (look_where<kPlanes>(scene, few, where)) return put_few(scene, few, where, out);
    if (moved == 1) shade_rows(scene, patch, layer.pixels, out);
  }
}

/// Shades what was collected in a tile, and leaves nothing of it. @param u, v  the tile's first pixel.
template <int kPlanes>
inline void shade_few(const SceneView& scene, const Frame& frame, int u, int v, Handful& few,
                      TileBytes (&out)[kPlanes]) {
  RowTaps where{};
  if (look_where<kPlanes>(scene, few, where)) {
    put_few(scene, few, where, out);
  } else {
    for (int i = 0; i < few.layer_count; ++i) shade_moved(scene, frame, few.layers[i], u, v, out);
  }
  few.count = few.layer_count = 0;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
