#pragma once

#include <cstddef>
#include <cstdint>

namespace hedgehop::sim::tiles {

inline constexpr int kTilePx = 8;  ///< side of a tile; one bit a pixel, row by row from the lowest bit

/// A pinhole's image: pixel (u, v), counted from the middle of the first, shows along ((u - center_u) * per_focal_x,
/// (v - center_v) * per_focal_y, 1) in C.
struct Lens {
  double focal_x_px, focal_y_px, per_focal_x, per_focal_y, center_u_px, center_v_px;
  int width_px, height_px;
};

/// Where an image is taken from, as seen from the frame of the facets.
struct Eye {
  double p_m[3];   ///< of C, in W or M
  double R_CW[9];  ///< row by row
};

/// An affine function of the pixel.
struct Affine {
  double right, down, at_origin;

  double at(double u, double v) const { return right * u + down * v + at_origin; }
};

/// A facet that can be seen, set up for one image.
struct Surface {
  Affine w;        ///< 1 / z in C, 1/m
  uint32_t facet;  ///< into the scene's
  uint32_t eye;    ///< into Frame::eyes
};

/// What a surface looks like, each over z, which makes it affine in the pixel: u and v in 1/256 texel, brightness, and
/// 1. The texture is moved by whole repeats to where floats are fine, as often as it has to be.
struct alignas(32) Paint {
  double right[4], down[4], at_origin[4];
};

/// The pixels of a tile that show one surface. Layers of a tile share no pixel.
struct Layer {
  uint64_t pixels;
  float nearest, farthest;  ///< 1 / z, between which the surface lies in this tile, 1/m
  uint32_t surface;         ///< into Frame::surfaces
};

/// Fills a line of the cache.
struct alignas(64) Tile {
  uint64_t covered;  ///< by the layers, or beyond the image
  float farthest;    ///< 1 / z beyond which all is hidden, 1/m; 0 while a pixel is not covered
  uint16_t count;    ///< of layers
  uint16_t capacity;
  union {
    Layer own[2];    ///< the layers, while they are no more
    uint32_t first;  ///< else where they begin in Frame::pool
  };
};
static_assert(sizeof(Tile) == 64);
inline constexpr uint16_t kOwnLayers = 2;

class FrameMemory;

/// What was drawn into an image's tiles so far: plain data, for kernels. As many grids of tiles as samples in a pixel.
struct Frame {
  Lens lens;
  int across, down, samples;
  Tile* tiles;  ///< grid by grid, row by row
  Eye* eyes;
  Surface* surfaces;  ///< with room for those of the facets that are drawn next
  Paint* paints;      ///< of the surfaces
  size_t surface_count;
  Layer* pool;
  FrameMemory* memory;  ///< that all of it lies in
};

inline Layer* layers(const Frame& frame, Tile& tile) {
  return tile.capacity == kOwnLayers ? tile.own : frame.pool + tile.first;
}
inline const Layer* layers(const Frame& frame, const Tile& tile) {
  return tile.capacity == kOwnLayers ? tile.own : frame.pool + tile.first;
}

/// Bits of the pixels of a tile that lie beyond an image of which `columns` and `rows` are left from its first pixel
/// on.
inline uint64_t beyond(int columns, int rows) {
  const uint64_t row = columns >= kTilePx ? 0u : 0xffu & (0xffu << columns);
  uint64_t pixels = row * 0x0101010101010101u;
  if (rows < kTilePx) pixels |= ~uint64_t{0} << (kTilePx * rows);
  return pixels;
}

/// Makes room for more layers of a tile that has no more. Layers may move.
void grow(Frame& frame, Tile& tile);

/// Offset of a sample from the middle of its pixel, 1/8 px to the right and down.
struct SamplePlace {
  int right, down;
};
/// The one sample of a pixel, or four as Mesa's rasteriser puts them.
inline constexpr SamplePlace kOneSample[1] = {{0, 0}};
inline constexpr SamplePlace kFourSamples[4] = {{-1, -3}, {3, -1}, {-3, 1}, {1, 3}};

}  // namespace hedgehop::sim::tiles
