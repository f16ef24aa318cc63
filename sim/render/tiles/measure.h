#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/lanes.h"
#include "sim/render/tiles/paint.h"
#include "sim/render/tiles/scene_view.h"

// What is measured of a surface in a tile, for each of the pixels that show it.
namespace hedgehop::sim::tiles {
namespace {

/// Puts a row's values where its pixels are shown. @param of_row  gives them.
template <class V, class Value, class OfRow>
inline void put_rows(uint64_t pixels, Value (&values)[64], const OfRow& of_row) {
  for (int row = 0; row < kTilePx; ++row) {
    const auto shown = static_cast<int32_t>(pixels >> kTilePx * row & 0xff);
    if (shown == 0) continue;
    if (shown == 0xff) {
      const V all_of_row = of_row(row);
      std::memcpy(values + kTilePx * row, &all_of_row, sizeof(all_of_row));
      continue;
    }
    V kept;
    std::memcpy(&kept, values + kTilePx * row, sizeof(kept));
    const I8 here = (all(shown) & I8{1, 2, 4, 8, 16, 32, 64, 128}) != 0;
    kept = pick(here, of_row(row), kept);
    std::memcpy(values + kTilePx * row, &kept, sizeof(kept));
  }
}

/// z in C, m.
struct DepthMeasure {
  void operator()(const Surface& surface, int u, int v, uint64_t pixels, float (&values)[64]) const {
    const Slope w = slope(surface.w, u, v);
    put_rows<F8>(pixels, values, [&](int row) { return 1.0f / w.row(row, kColumns); });
  }
};

/// 1 / z in C, 1/m, and how it changes to the next pixel on the right and below.
struct PlaneValue {
  float per_z, right, down, none;
};
struct PlaneMeasure {
  void operator()(const Surface& surface, int u, int v, uint64_t pixels, PlaneValue (&values)[64]) const {
    const Slope w = slope(surface.w, u, v);
    for (; pixels != 0; pixels &= pixels - 1) {
      const int i = __builtin_ctzll(pixels), row = i / kTilePx, column = i % kTilePx;
      const float per_z = (w.at_first + static_cast<float>(row) * w.down) + static_cast<float>(column) * w.right;
      values[i] = {per_z, w.right, w.down, 0.0f};
    }
  }
};

struct LabelMeasure {
  const FacetCover* covers;

  void operator()(const Surface& surface, int, int, uint64_t pixels, int32_t (&values)[64]) const {
    const I8 label = all(covers[surface.facet].label);
    put_rows<I8>(pixels, values, [&](int) { return label; });
  }
};

}  // namespace
}  // namespace hedgehop::sim::tiles
