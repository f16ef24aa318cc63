#pragma once

#include "sim/render/tiles/interpolants.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/pixel_group.h"
#include "sim/render/tiles/shade.h"

namespace hedgehop::sim::tiles {
namespace {

/// The layers of a tile, at one sample of each pixel.
struct TileLayers {
  const Layer* layers;
  uint16_t count;
};

inline TileLayers layers_at(const Frame& frame, int column, int row, int sample) {
  const size_t grid_tiles = static_cast<size_t>(frame.across) * static_cast<size_t>(frame.down);
  Tile& tile = frame.tiles[static_cast<size_t>(sample) * grid_tiles +
                           static_cast<size_t>(row) * static_cast<size_t>(frame.across) + static_cast<size_t>(column)];
  return {layers(frame, tile), tile.count};
}

/// @param inside  pixels of the tile that are within the image.
template <int kPlanes>
inline void shade_tile(const SceneView& scene, const Frame& frame, int column, int row, uint64_t inside,
                       TileBytes (&out)[kPlanes]) {
  const int u = kTilePx * column, v = kTilePx * row;
  const TileLayers tile = layers_at(frame, column, row, 0);
  uint64_t sky = inside;
  PixelGroup group;
  for (uint16_t i = 0; i < tile.count; ++i) {
    const Layer& layer = tile.layers[i];
    sky &= ~layer.pixels;
    const int count = __builtin_popcountll(layer.pixels);
    if (count > kGroupSize) {
      shade(scene, frame, layer.surface, u, v, layer.pixels, out);
      continue;
    }
    if (group.count + count > kGroupSize) shade_group(scene, frame, u, v, group, out);
    group.add(scene, patch_of(scene, frame, layer.surface, u, v), layer.surface, layer.pixels);
  }
  if (group.count > 0) shade_group(scene, frame, u, v, group, out);
  if (sky != 0) shade_sky(scene, frame.lens, u, v, sky, out);
}

/// A surface or the sky, and its pixels at each of four samples.
struct SampleCoverage {
  uint64_t pixels[4];
  uint32_t surface;
};
inline constexpr uint32_t kSky = 0xffffffffu;
inline constexpr int kMaxCoverages = 4 * 64 + 1;

inline int coverages_of(const Frame& frame, int column, int row, uint64_t inside,
                        SampleCoverage (&coverages)[kMaxCoverages]) {
  int count = 1;
  coverages[0] = {{inside, inside, inside, inside}, kSky};
  for (int sample = 0; sample < 4; ++sample) {
    const TileLayers tile = layers_at(frame, column, row, sample);
    for (uint16_t i = 0; i < tile.count; ++i) {
      const Layer& layer = tile.layers[i];
      int at = 1;
      while (at < count && coverages[at].surface != layer.surface) ++at;
      if (at == count) coverages[count++] = {{0, 0, 0, 0}, layer.surface};
      coverages[at].pixels[sample] = layer.pixels;
      coverages[0].pixels[sample] &= ~layer.pixels;
    }
  }
  return count;
}

using Sums = uint16_t __attribute__((vector_size(16)));

template <int kPlanes>
inline void shade_surface(const SceneView& scene, const Frame& frame, uint32_t surface, int u, int v, uint64_t pixels,
                          TileBytes (&out)[kPlanes]) {
  if (__builtin_popcountll(pixels) > kGroupSize) return shade(scene, frame, surface, u, v, pixels, out);
  PixelGroup group;
  group.add(scene, patch_of(scene, frame, surface, u, v), surface, pixels);
  shade_group(scene, frame, u, v, group, out);
}

/// Shades each surface once, at the pixel centers, and averages over the samples.
template <int kPlanes>
inline void mix_tile(const SceneView& scene, const Frame& frame, int column, int row, uint64_t inside,
                     TileBytes (&out)[kPlanes]) {
  SampleCoverage coverages[kMaxCoverages];
  const int count = coverages_of(frame, column, row, inside, coverages);
  Sums sums[kPlanes][kTilePx] = {};
  for (int k = 0; k < count; ++k) {
    const SampleCoverage& share = coverages[k];
    const uint64_t pixels = share.pixels[0] | share.pixels[1] | share.pixels[2] | share.pixels[3];
    if (pixels == 0) continue;
    const int u = kTilePx * column, v = kTilePx * row;
    if (share.surface == kSky) {
      shade_sky(scene, frame.lens, u, v, pixels, out);
    } else {
      shade_surface(scene, frame, share.surface, u, v, pixels, out);
    }
    for (int y = 0; y < kTilePx; ++y) {
      if (row_of(pixels, y) == 0) continue;
      uint64_t times = 0;
      for (const uint64_t sample : share.pixels) times += kByteMasks.bytes[row_of(sample, y)] & 0x0101010101010101u;
      for (int i = 0; i < kPlanes; ++i) {
        for (int x = 0; x < kTilePx; ++x) {
          sums[i][y][x] = static_cast<uint16_t>(sums[i][y][x] + (times >> 8 * x & 7) * (out[i].rows[y] >> 8 * x & 255));
        }
      }
    }
  }
  for (int i = 0; i < kPlanes; ++i) {
    for (int y = 0; y < kTilePx; ++y) {
      out[i].rows[y] = 0;
      for (int x = 0; x < kTilePx; ++x) out[i].rows[y] |= static_cast<uint64_t>((sums[i][y][x] + 2) >> 2) << 8 * x;
    }
  }
}

/// The top left pixel of a tile in an image, and the part of the tile within the image.
struct Window {
  uint8_t* first;
  int columns, rows;
};

inline Window window_of(const Frame& frame, const ImageMemory& image, int column, int row, size_t pixel_bytes) {
  const int u = kTilePx * column, v = kTilePx * row;
  const auto left = [](int size, int from) { return size - from < kTilePx ? size - from : kTilePx; };
  return {image.data + static_cast<size_t>(v) * image.step + static_cast<size_t>(u) * pixel_bytes,
          left(frame.lens.width_px, u), left(frame.lens.height_px, v)};
}

inline void write(const TileBytes (&planes)[1], const Window& to, size_t step) {
  for (int y = 0; y < to.rows; ++y) {
    uint8_t* const row = to.first + static_cast<size_t>(y) * step;
    if (to.columns == kTilePx) {
      std::memcpy(row, &planes[0].rows[y], kTilePx);
    } else {
      for (int x = 0; x < to.columns; ++x) row[x] = static_cast<uint8_t>(planes[0].rows[y] >> 8 * x);
    }
  }
}

inline void write(const TileBytes (&planes)[3], const Window& to, size_t step) {
  for (int y = 0; y < to.rows; ++y) {
    uint8_t* pixel = to.first + static_cast<size_t>(y) * step;
    uint64_t r = planes[0].rows[y], g = planes[1].rows[y], b = planes[2].rows[y];
    for (int x = 0; x < to.columns; ++x, pixel += 3, r >>= 8, g >>= 8, b >>= 8) {
      pixel[0] = static_cast<uint8_t>(r);
      pixel[1] = static_cast<uint8_t>(g);
      pixel[2] = static_cast<uint8_t>(b);
    }
  }
}

/// The attributes of surfaces are scattered in memory. They are prefetched some surfaces ahead.
inline void make_interpolants(const SceneView& scene, const Frame& frame) {
  constexpr size_t kAhead = 12;
  for (size_t i = 0; i < frame.surface_count; ++i) {
    if (i + kAhead < frame.surface_count) {
      const uint32_t facet = frame.surfaces[i + kAhead].facet;
      __builtin_prefetch(scene.attributes + facet);
      __builtin_prefetch(scene.shapes + facet);
    }
    frame.interpolants[i] = interpolants_of(scene, frame, frame.surfaces[i]);
  }
}

template <int kPlanes>
inline void shade_image(const SceneView& scene, Frame& frame, const ImageMemory& image) {
  make_interpolants(scene, frame);
  if (scene.sun.depths != nullptr) frame.sun = sun_view(scene, frame.lens);
  TileBytes out[kPlanes] = {};  // mix_tile() multiplies unwritten bytes by 0
  for (int row = 0; row < frame.down; ++row) {
    for (int column = 0; column < frame.across; ++column) {
      const Window window = window_of(frame, image, column, row, kPlanes);
      const uint64_t inside = ~beyond(frame.lens.width_px - kTilePx * column, frame.lens.height_px - kTilePx * row);
      if (frame.samples == 1) {
        shade_tile(scene, frame, column, row, inside, out);
      } else {
        mix_tile(scene, frame, column, row, inside, out);
      }
      write(out, window, image.step);
    }
  }
}

template <class Value>
inline void write_values(const Value (&values)[kTilePx * kTilePx], const Window& to, size_t step) {
  for (int y = 0; y < to.rows; ++y) {
    uint8_t* const row = to.first + static_cast<size_t>(y) * step;
    if (to.columns == kTilePx) {
      std::memcpy(row, values + kTilePx * y, sizeof(Value) * kTilePx);
    } else {
      std::memcpy(row, values + kTilePx * y, sizeof(Value) * static_cast<size_t>(to.columns));
    }
  }
}

/// Writes an image of other values than levels; `background` for pixels without a layer.
template <class Value, class Measure>
inline void measure_image(const Frame& frame, const ImageMemory& image, const Value& background,
                          const Measure& measure) {
  Value values[kTilePx * kTilePx] = {};
  for (int row = 0; row < frame.down; ++row) {
    for (int column = 0; column < frame.across; ++column) {
      const TileLayers tile = layers_at(frame, column, row, 0);
      uint64_t empty = ~uint64_t{0};
      for (uint16_t i = 0; i < tile.count; ++i) {
        const Layer& layer = tile.layers[i];
        measure(frame.surfaces[layer.surface], kTilePx * column, kTilePx * row, layer.pixels, values);
        empty &= ~layer.pixels;
      }
      if (~empty == 0) {
        for (Value& value : values) value = background;
      } else {
        for (; empty != 0; empty &= empty - 1) values[__builtin_ctzll(empty)] = background;
      }
      write_values(values, window_of(frame, image, column, row, sizeof(Value)), image.step);
    }
  }
}

/// As Kernels::finish.
inline void finish(const SceneView& scene, Frame& frame, Raster raster, const ImageMemory& image) {
  switch (raster) {
    case Raster::grey:
      return shade_image<1>(scene, frame, image);
    case Raster::color:
      return shade_image<3>(scene, frame, image);
    case Raster::depth:
      return measure_image(frame, image, __builtin_inff(), DepthMeasure{});
    case Raster::planes:
      return measure_image(frame, image, PlaneValue{}, PlaneMeasure{});
    case Raster::labels:
      return measure_image(frame, image, int32_t{0}, LabelMeasure{scene.attributes});
  }
}

}  // namespace
}  // namespace hedgehop::sim::tiles
