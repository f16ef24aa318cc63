#pragma once

#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/simd.h"

namespace hedgehop::sim::tiles {
namespace {

/// Positions in a texture, in 1/256 texel of the largest size from the corner of the first texel.
struct TexturePositions {
  I8 u, v;
};

/// Four texels around a position, and their weights.
struct Taps {
  I8 place;
  I8 below;  ///< position of the lower two; for colors only
  I8 right, down;
};

/// The layout of a level in its texture. @tparam N  int for all lanes, or I8 with one number per lane.
template <class N>
struct LevelLayout {
  N level, last;  ///< last column and row
  N size_log2, first;
};
inline LevelLayout<int> level_layout(const TextureLayout& layout, int level) {
  return {level, (layout.size_px >> level) - 1, layout.size_log2 - level, layout.first[level]};
}
inline LevelLayout<I8> level_layout(const TextureLayout& layout, I8 level) {
  return {level, (all(layout.size_px) >> level) - 1, layout.size_log2 - level, look_up(layout.first, level)};
}

template <int kPlanes, class N>
inline Taps taps(const LevelLayout<N>& in, const TexturePositions& at) {
  constexpr int kHalf = 128;
  const I8 u = (at.u >> in.level) - kHalf, v = (at.v >> in.level) - kHalf;
  const I8 x = (u >> 8) & in.last, y = (v >> 8) & in.last;
  const auto place = [&](I8 row) { return in.first + (row << in.size_log2) + row + x; };
  Taps taps;
  taps.place = place(y);
  taps.right = u & 255;
  taps.down = v & 255;
  if (kPlanes > 1) taps.below = place((y + 1) & in.last);
  return taps;
}

/// Returns weighted means of texels, minus 128, in units of 1/65025 level.
inline void fetch(const Texels& texels, size_t texture, const Taps& taps, I8 (&means)[1]) {
  means[0] = mix(gather(texels.greys + texture, taps.place), taps.right, taps.down);
}
inline void fetch(const Texels& texels, size_t texture, const Taps& taps, I8 (&means)[3]) {
  mix(texels.colors + texture, taps.place, taps.below, taps.right, taps.down, means);
}

/// The two sizes of a texture that are blended: the level of the larger one, and the share of the smaller one.
struct MipLevels {
  I8 larger;
  F8 share;
};

/// Returns the levels for a pixel size. The logarithm is approximated linearly between powers of two of the square, as
/// in Mesa's rasterizer.
/// @param texels_squared  square of the texels of the largest size that a pixel spans, maximum over both axes.
inline MipLevels mip_levels(F8 texels_squared, int last) {
  constexpr int kBits = 24;  // of a fraction: half the exponent is the level
  const I8 twice = reinterpret_cast<I8>(texels_squared) - (127 << (kBits - 1));
  const I8 level = twice >> kBits;
  const I8 between = (level >= 0) & (level < last);
  const I8 fraction = twice & ((1 << kBits) - 1) & between;
  return {maximum(minimum(level, all(last)), I8{}), floats(fraction) * (1.0f / (1 << kBits))};
}

}  // namespace
}  // namespace hedgehop::sim::tiles
