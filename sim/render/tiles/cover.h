#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/rows.h"
#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/set_up.h"
#include "sim/render/tiles/simd.h"

namespace hedgehop::sim::tiles {
namespace {

/// Returns the pixels of a tile at which an affine function is positive. @param at_first  value at the first pixel.
inline uint64_t where_positive(float at_first, float right, float down) {
  const FloatRows along = rows_of(kColumns * right);
  uint64_t pixels = 0;
  for (int row = 0; row < kTilePx; row += kRows) {
    const FloatRows value = ((row_numbers() + static_cast<float>(row)) * down + at_first) + along;
    pixels |= static_cast<uint64_t>(positive(value)) << kTilePx * row;
  }
  return pixels;
}

/// Returns the pixels of a tile on the inner side of an edge that crosses it.
/// @param at_first  value at the first pixel. @param right, down  change per eighth of a pixel.
inline uint64_t inside(int64_t at_first, int64_t right, int64_t down) {
  const I8 columns = {0, 8, 16, 24, 32, 40, 48, 56};
  const auto next_row = static_cast<int32_t>(8 * down);
  IntRows value = rows_of(static_cast<int32_t>(at_first) + columns * static_cast<int32_t>(right)) +
                  integers(row_numbers()) * next_row;
  uint64_t outside = 0;
  for (int row = 0; row < kTilePx; row += kRows) {
    outside |= static_cast<uint64_t>(signs(value)) << kTilePx * row;
    value += kRows * next_row;
  }
  return ~outside;
}

/// 1 / z over a tile, 1/m: at the first pixel, its change per pixel, and its bounds.
struct TileDepths {
  float at_first, right, down, nearest, farthest;
};

/// Returns the pixels of a tile at which surface a is in front of surface b. At equal depth, the facet with the higher
/// index is in front, independent of the drawing order.
inline uint64_t pixels_in_front(const Surface& a, const Surface& b, double u, double v) {
  const double right = a.w.right - b.w.right, down = a.w.down - b.w.down;
  const double first = (a.w.at_origin - b.w.at_origin) + right * u + down * v;
  if (a.facet > b.facet) {
    return ~where_positive(-static_cast<float>(first), -static_cast<float>(right), -static_cast<float>(down));
  }
  return where_positive(static_cast<float>(first), static_cast<float>(right), static_cast<float>(down));
}

/// Inserts pixels of a surface into a tile with its layers. Returns whether any of the pixels is visible.
inline bool put(Frame& frame, Tile& tile, uint64_t pixels, const TileDepths& w, uint32_t surface, double u, double v) {
  bool uncovers = false;  // whether layers lose pixels
  if (w.nearest < tile.farthest) {
    pixels &= ~tile.covered;
    if (pixels == 0) return false;
  } else if ((pixels & tile.covered) != 0) {
    Layer* layer = layers(frame, tile);
    for (uint16_t i = 0; i < tile.count;) {
      const uint64_t both = pixels & layer[i].pixels;
      if (both != 0) {
        uint64_t in_front = 0;
        if (w.farthest > layer[i].nearest) {
          in_front = both;
        } else if (w.nearest >= layer[i].farthest) {
          in_front = both & pixels_in_front(frame.surfaces[surface], frame.surfaces[layer[i].surface], u, v);
        }
        layer[i].pixels &= ~in_front;
        uncovers |= in_front != 0;
        pixels &= ~both | in_front;
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
  if (tile.count == 1) {
    tile.farthest = w.farthest;
  } else if (!uncovers) {
    tile.farthest = w.farthest < tile.farthest ? w.farthest : tile.farthest;
  } else {
    float farthest = layer[0].farthest;
    for (uint16_t i = 1; i < tile.count; ++i) farthest = layer[i].farthest < farthest ? layer[i].farthest : farthest;
    tile.farthest = farthest;
  }
  return true;
}

/// Draws a facet into one grid of tiles. Returns whether any of its pixels is visible.
inline bool cover(Frame& frame, Tile* tiles, const FacetSetUp& facet, const SampleOffset& sample, float near_w,
                  uint32_t surface) {
  const int left = facet.extent.left / kTilePx, right = facet.extent.right / kTilePx;
  const int top = facet.extent.top / kTilePx, bottom = facet.extent.bottom / kTilePx;
  const Edges& edges = facet.edges;
  const L4 zero = {};
  const L4 max_inside = 56 * (pick(edges.right > 0, edges.right, zero) + pick(edges.down > 0, edges.down, zero));
  const L4 min_inside = 56 * (pick(edges.right < 0, edges.right, zero) + pick(edges.down < 0, edges.down, zero));
  const Affine& plane = facet.surface.w;
  const double offset = plane.at(0.125 * sample.right, 0.125 * sample.down);
  const auto w_right = static_cast<float>(plane.right), w_down = static_cast<float>(plane.down);
  const float half = 3.5f * ((w_right < 0.0f ? -w_right : w_right) + (w_down < 0.0f ? -w_down : w_down));
  const float middle = 3.5f * (w_right + w_down);
  bool visible = false;
  for (int row = top; row <= bottom; ++row) {
    L4 at_first =
        edges.at_first + times(edges.right, 64 * left + sample.right) + times(edges.down, 64 * row + sample.down);
    Tile* tile = tiles + static_cast<size_t>(row) * static_cast<size_t>(frame.across) + left;
    for (int column = left; column <= right; ++column, ++tile, at_first += 64 * edges.right) {
      if (signs(at_first + max_inside) != 0) continue;
      const double u = kTilePx * column, v = kTilePx * row;
      TileDepths w;
      w.at_first = static_cast<float>(offset + plane.right * u + plane.down * v);
      w.nearest = w.at_first + middle + half;
      w.nearest = w.nearest < facet.nearest ? w.nearest : facet.nearest;
      if (w.nearest < tile->farthest && ~tile->covered == 0) continue;
      w.farthest = w.at_first + middle - half;
      w.farthest = w.farthest > facet.farthest ? w.farthest : facet.farthest;
      uint64_t pixels = ~uint64_t{0};
      for (uint32_t crossing = signs(at_first + min_inside); crossing != 0; crossing &= crossing - 1) {
        const int i = __builtin_ctz(crossing);
        pixels &= inside(at_first[i], edges.right[i], edges.down[i]);
      }
      if (w.nearest > near_w) pixels &= where_positive(near_w - w.at_first, -w_right, -w_down);
      pixels &= ~beyond(frame.lens.width_px - kTilePx * column, frame.lens.height_px - kTilePx * row);
      if (pixels == 0) continue;
      visible |= put(frame, *tile, pixels, w, surface, u + 0.125 * sample.right, v + 0.125 * sample.down);
    }
  }
  return visible;
}

/// Returns which of eight facets may face the camera. set_up() decides exactly.
inline uint32_t facing(const FacetPlanes& planes, uint32_t first, const ViewPose& pose) {
  const auto load = [first](const float* from) {
    F8 numbers;
    std::memcpy(&numbers, from + first, sizeof(numbers));
    return numbers;
  };
  const auto part = [](double a) { return static_cast<float>(a); };
  constexpr float kMarginM = 0.02f;  // larger than the rounding of floats within 100 km
  const F8 above_m = load(planes.n_x) * part(pose.p_m[0]) + load(planes.n_y) * part(pose.p_m[1]) +
                     load(planes.n_z) * part(pose.p_m[2]) - load(planes.offset_m);
  return signs(above_m > -kMarginM);
}

inline void draw(Frame& frame, const FacetShape& shape, uint32_t facet, uint32_t pose, double near_m) {
  const SampleOffset* samples = frame.samples == 1 ? kOneSample : kFourSamples;
  const double margin_px = frame.samples == 1 ? 0.0 : 0.375;
  const size_t grid_tiles = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  FacetSetUp set;
  if (!set_up(shape, frame.poses[pose], frame.lens, near_m, margin_px, set)) return;
  set.surface.facet = facet;
  set.surface.pose = pose;
  frame.surfaces[frame.surface_count] = set.surface;
  bool visible = false;
  for (int i = 0; i < frame.samples; ++i) {
    visible |= cover(frame, frame.tiles + static_cast<size_t>(i) * grid_tiles, set, samples[i],
                     static_cast<float>(1.0 / near_m), static_cast<uint32_t>(frame.surface_count));
  }
  frame.surface_count += visible ? 1 : 0;
}

/// Requests the first facets of a stretch from memory, which is slower than drawing them.
inline void prefetch(const FacetShape* shapes, uint32_t count) {
  constexpr size_t kLineBytes = 64, kMaxBytes = 1024;
  const size_t bytes = count * sizeof(FacetShape);
  const auto* const from = reinterpret_cast<const char*>(shapes);
  for (size_t at = 0; at < bytes && at < kMaxBytes; at += kLineBytes) __builtin_prefetch(from + at);
}

/// Draws `count` facets of the scene from index `first`.
inline void draw(Frame& frame, const SceneView& scene, uint32_t first, uint32_t count, uint32_t pose, double near_m) {
  prefetch(scene.shapes + first, count);
  for (const uint32_t end = first + count; first < end; first += 8) {
    uint32_t faces = facing(scene.planes_of_facets, first, frame.poses[pose]);
    if (end - first < 8) faces &= (1u << (end - first)) - 1;
    for (; faces != 0; faces &= faces - 1) {
      const uint32_t facet = first + static_cast<uint32_t>(__builtin_ctz(faces));
      draw(frame, scene.shapes[facet], facet, pose, near_m);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
