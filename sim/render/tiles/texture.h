#pragma once

#include "sim/render/tiles/rows.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {
namespace {

/// Positions in a texture, in 1/256 texel of the largest size from the corner of the first texel.
/// @tparam I  eight or sixteen lanes.
template <class I>
struct TexturePositions {
  I u, v;
};

/// Four texels around a position.
template <class I>
struct Taps {
  I place;
  I below;  ///< position of the lower two; for colors only
  I u, v;   ///< position in 1/256 texel from the first of them; only the lowest byte counts
};

/// The layout of a level in its texture. @tparam N  int for all lanes, or one number per lane.
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

inline LevelLayout<IntRows> rows_of(const LevelLayout<I8>& row) {
  return {rows_of(row.level), rows_of(row.last), rows_of(row.size_log2), rows_of(row.first)};
}

template <int kPlanes, class N, class I>
inline Taps<I> taps(const LevelLayout<N>& in, const TexturePositions<I>& at) {
  constexpr int kHalf = 128;
  const I u = (at.u >> in.level) - kHalf, v = (at.v >> in.level) - kHalf;
  const I x = (u >> 8) & in.last, y = (v >> 8) & in.last;
  const auto place = [&](I row) { return (row << in.size_log2) + row + x + in.first; };
  Taps<I> taps;
  taps.place = place(y);
  taps.u = u;
  taps.v = v;
  if (kPlanes > 1) taps.below = place((y + 1) & in.last);
  return taps;
}

/// Returns weighted means of texels, minus 128, in units of 1/65025 level.
inline void fetch(const Texels& texels, size_t texture, const Taps<IntRows>& taps, IntRows (&means)[1]) {
  const int32_t* const places = reinterpret_cast<const int32_t*>(&taps.place);
  means[0] = mix(gather_rows(texels.greys + texture, places), taps.u, taps.v);
}
inline void fetch(const Texels& texels, size_t texture, const Taps<I8>& taps, I8 (&means)[3]) {
  mix(texels.colors + texture, taps.place, taps.below, taps.u, taps.v, means);
}
#ifdef __AVX512VL__
inline void fetch(const Texels& texels, size_t texture, const Taps<I8>& taps, I8 (&means)[1]) {
  const int32_t* const places = reinterpret_cast<const int32_t*>(&taps.place);
  means[0] = mix(gather(texels.greys + texture, places), taps.u, taps.v);
}
inline void fetch(const Texels& texels, size_t texture, const Taps<IntRows>& taps, IntRows (&means)[3]) {
  I8 upper[3], lower[3];
  const auto row = [&](int i) -> Taps<I8> {
    return {row_of(taps.place, i), row_of(taps.below, i), row_of(taps.u, i), row_of(taps.v, i)};
  };
  fetch(texels, texture, row(0), upper);
  fetch(texels, texture, row(1), lower);
  for (int i = 0; i < 3; ++i) means[i] = rows_of(upper[i], lower[i]);
}
#endif

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
