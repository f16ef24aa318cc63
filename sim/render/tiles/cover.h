#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/lanes.h"
#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/set_up.h"

namespace hedgehop::sim::tiles {
namespace {

/// Pixels of a tile where an affine function is above 0. @param at_first  at the tile's first pixel.
inline uint64_t where_positive(float at_first, float right, float down) {
  const F8 along = kColumns * right;
  uint64_t pixels = 0;
  for (int row = 0; row < kTilePx; ++row) {
    const F8 value = (at_first + static_cast<float>(row) * down) + along;
    pixels |= static_cast<uint64_t>(signs(reinterpret_cast<I8>(value > 0.0f))) << kTilePx * row;
  }
  return pixels;
}

/// Pixels of a tile on the inner side of an edge that passes through it.
/// @param at_first  at the tile's first pixel. @param right, down  an eighth of a pixel on.
inline uint64_t inside(int64_t at_first, int64_t right, int64_t down) {
  const I8 columns = {0, 8, 16, 24, 32, 40, 48, 56};
  I8 value = static_cast<int32_t>(at_first) + columns * static_cast<int32_t>(right);
  const I8 next_row = all(static_cast<int32_t>(8 * down));
  uint64_t outside = 0;
  for (int row = 0; row < kTilePx; ++row) {
    outside |= static_cast<uint64_t>(signs(value)) << kTilePx * row;
    value += next_row;
  }
  return ~outside;
}

/// 1 / z over a tile: at its first pixel, between the pixels, and the bounds.
struct Depths {
  float at_first, right, down, nearest, farthest;
};

/// Pixels of a tile at which surface a, drawn now, lies before b. Of two at the same place the later facet counts, in
/// whatever order they are drawn.
inline uint64_t where_before(const Surface& a, const Surface& b, double u, double v) {
  const double right = a.w.right - b.w.right, down = a.w.down - b.w.down;
  const double first = (a.w.at_origin - b.w.at_origin) + right * u + down * v;
  if (a.facet > b.facet) {
    return ~where_positive(-static_cast<float>(first), -static_cast<float>(right), -static_cast<float>(down));
  }
  return where_positive(static_cast<float>(first), static_cast<float>(right), static_cast<float>(down));
}

/// Puts pixels of a surface into a tile: behind, before or across the layers that are there.
/// @return whether any of them shows.
inline bool put(Frame& frame, Tile& tile, uint64_t pixels, const Depths& w, uint32_t surface, double u, double v) {
  if ((pixels & tile.covered) != 0) {
    Layer* layer = layers(frame, tile);
    for (uint16_t i = 0; i < tile.count;) {
      const uint64_t both = pixels & layer[i].pixels;
      if (both != 0) {
        uint64_t before = 0;
        if (w.farthest > layer[i].nearest) {
          before = both;
        } else if (w.nearest >= layer[i].farthest) {
          before = both & where_before(frame.surfaces[surface], frame.surfaces[layer[i].surface], u, v);
        }
        layer[i].pixels &= ~before;
        pixels &= ~both | before;
        if (layer[i].pixels == 0) {
          layer[i] = layer[--tile.count];
          continue;
        }
        if (pixels == 0) return false;
      }
      ++i;
    }
  }
  if (tile.count == tile.capacity) grow(frame, tile);
  Layer* layer = layers(frame, tile);
  layer[tile.count++] = {pixels, w.nearest, w.farthest, surface};
  tile.covered |= pixels;
  tile.farthest = 0.0f;
  if (~tile.covered == 0) {
    float farthest = layer[0].farthest;
    for (uint16_t i = 1; i < tile.count; ++i) farthest = layer[i].farthest < farthest ? layer[i].farthest : farthest;
    tile.farthest = farthest;
  }
  return true;
}

/// Draws a facet that was set up into one grid of tiles. @return whether any of it shows.
inline bool cover(Frame& frame, Tile* tiles, const SetUp& facet, const SamplePlace& sample, float near_w,
                  uint32_t surface) {
  const int left = facet.extent.left / kTilePx, right = facet.extent.right / kTilePx;
  const int top = facet.extent.top / kTilePx, bottom = facet.extent.bottom / kTilePx;
  const Edges& edges = facet.edges;
  const L4 nought = {};
  const L4 most_inside = 56 * (pick(edges.right > 0, edges.right, nought) + pick(edges.down > 0, edges.down, nought));
  const L4 least_inside = 56 * (pick(edges.right < 0, edges.right, nought) + pick(edges.down < 0, edges.down, nought));
  const Affine& plane = facet.surface.w;
  const double offset = plane.at(0.125 * sample.right, 0.125 * sample.down);
  const auto w_right = static_cast<float>(plane.right), w_down = static_cast<float>(plane.down);
  const float half = 3.5f * ((w_right < 0.0f ? -w_right : w_right) + (w_down < 0.0f ? -w_down : w_down));
  const float middle = 3.5f * (w_right + w_down);
  bool shows = false;
  for (int row = top; row <= bottom; ++row) {
    L4 at_first =
        edges.at_first + times(edges.right, 64 * left + sample.right) + times(edges.down, 64 * row + sample.down);
    Tile* tile = tiles + static_cast<size_t>(row) * static_cast<size_t>(frame.across) + left;
    for (int column = left; column <= right; ++column, ++tile, at_first += 64 * edges.right) {
      if (signs(at_first + most_inside) != 0) continue;
      const double u = kTilePx * column, v = kTilePx * row;
      Depths w;
      w.at_first = static_cast<float>(offset + plane.right * u + plane.down * v);
      w.nearest = w.at_first + middle + half;
      w.nearest = w.nearest < facet.nearest ? w.nearest : facet.nearest;
      if (w.nearest < tile->farthest) continue;
      w.farthest = w.at_first + middle - half;
      w.farthest = w.farthest > facet.farthest ? w.farthest : facet.farthest;
      uint64_t pixels = ~uint64_t{0};
      for (uint32_t crossing = signs(at_first + least_inside); crossing != 0; crossing &= crossing - 1) {
        const int i = __builtin_ctz(crossing);
        pixels &= inside(at_first[i], edges.right[i], edges.down[i]);
      }
      if (w.nearest > near_w) pixels &= where_positive(near_w - w.at_first, -w_right, -w_down);
      pixels &= ~beyond(frame.lens.width_px - kTilePx * column, frame.lens.height_px - kTilePx * row);
      if (pixels == 0) continue;
      shows |= put(frame, *tile, pixels, w, surface, u + 0.125 * sample.right, v + 0.125 * sample.down);
    }
  }
  return shows;
}

/// Which of eight facets face the eye, or nearly so: set_up() decides.
inline uint32_t facing(const FacetPlanes& planes, uint32_t first, const Eye& eye) {
  const auto load = [first](const float* from) {
    F8 numbers;
    std::memcpy(&numbers, from + first, sizeof(numbers));
    return numbers;
  };
  const auto part = [](double a) { return static_cast<float>(a); };
  constexpr float kSpareM = 0.02f;  // more than floats lose within 100 km
  const F8 above_m = load(planes.n_x) * part(eye.p_m[0]) + load(planes.n_y) * part(eye.p_m[1]) +
                     load(planes.n_z) * part(eye.p_m[2]) - load(planes.offset_m);
  return signs(above_m > -kSpareM);
}

inline void draw(Frame& frame, const FacetShape& shape, uint32_t facet, uint32_t eye, double near_m) {
  const SamplePlace* samples = frame.samples == 1 ? kOneSample : kFourSamples;
  const double spare_px = frame.samples == 1 ? 0.0 : 0.375;
  const size_t a_grid = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  SetUp set;
  if (!set_up(shape, frame.eyes[eye], frame.lens, near_m, spare_px, set)) return;
  set.surface.facet = facet;
  set.surface.eye = eye;
  frame.surfaces[frame.surface_count] = set.surface;
  bool shows = false;
  for (int i = 0; i < frame.samples; ++i) {
    shows |= cover(frame, frame.tiles + static_cast<size_t>(i) * a_grid, set, samples[i],
                   static_cast<float>(1.0 / near_m), static_cast<uint32_t>(frame.surface_count));
  }
  frame.surface_count += shows ? 1 : 0;
}

/// Draws facets, counted on from one of the scene's.
inline void draw(Frame& frame, const SceneView& scene, uint32_t first, uint32_t count, uint32_t eye, double near_m) {
  for (const uint32_t end = first + count; first < end; first += 8) {
    uint32_t faces = facing(scene.planes_of_facets, first, frame.eyes[eye]);
    if (end - first < 8) faces &= (1u << (end - first)) - 1;
    for (; faces != 0; faces &= faces - 1) {
      const uint32_t facet = first + static_cast<uint32_t>(__builtin_ctz(faces));
      draw(frame, scene.shapes[facet], facet, eye, near_m);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
