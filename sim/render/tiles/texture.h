#pragma once

#include "sim/render/tiles/lanes.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {
namespace {

/// Places in a texture at which pixels look it up, in 1/256 texel of its largest size, from the corner of the first.
struct Places {
  I8 u, v;
};

/// Four texels round a place and how they are weighed.
struct Taps {
  I8 place;
  I8 below;  ///< place of the lower two; for colors only
  I8 right, down;
};

/// Where a level lies in its texture. @tparam N  a number for all lanes, or one for each.
template <class N>
struct LevelPlaces {
  N level, last;  ///< of its columns and rows
  N size_log2, first;
};
inline LevelPlaces<int> level_places(const TextureLayout& layout, int level) {
  return {level, (layout.size_px >> level) - 1, layout.size_log2 - level, layout.first[level]};
}
inline LevelPlaces<I8> level_places(const TextureLayout& layout, I8 level) {
  return {level, (all(layout.size_px) >> level) - 1, layout.size_log2 - level, look_up(layout.first, level)};
}

template <int kPlanes, class N>
inline Taps taps(const LevelPlaces<N>& in, const Places& at) {
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

/// Means of texels, 128 * 65025 less than they are, in 1/65025 of a level.
inline void fetch(const Texels& texels, size_t texture, const Taps& taps, I8 (&means)[1]) {
  means[0] = mix(gather(texels.greys + texture, taps.place), taps.right, taps.down);
}
inline void fetch(const Texels& texels, size_t texture, const Taps& taps, I8 (&means)[3]) {
  mix(texels.colors + texture, taps.place, taps.below, taps.right, taps.down, means);
}

/// Which two sizes of a texture pixels are looked up in, and the smaller one's share.
struct Levels {
  I8 larger;
  F8 share;
};

/// The logarithm is linear from one power of two of the square to the next, as Mesa's rasteriser has it.
/// @param texels_squared  of the largest size, that a pixel spans along the axis where it spans most.
inline Levels levels(F8 texels_squared, int last) {
  constexpr int kBits = 24;  // of a fraction: half the exponent is the level
  const I8 twice = reinterpret_cast<I8>(texels_squared) - (127 << (kBits - 1));
  const I8 level = twice >> kBits;
  const I8 between = (level >= 0) & (level < last);
  const I8 fraction = twice & ((1 << kBits) - 1) & between;
  return {most(least(level, all(last)), I8{}), floats(fraction) * (1.0f / (1 << kBits))};
}

}  // namespace
}  // namespace hedgehop::sim::tiles
