#pragma once

#include <cstddef>
#include <cstdint>

namespace hedgehop::sim::tiles {

inline constexpr int kTilePx = 8;  ///< side of a tile; one bit per pixel, row-major from the lowest bit

/// A pinhole image. The ray of pixel (u, v) is ((u - center_u) * per_focal_x, (v - center_v) * per_focal_y, 1) in C;
/// (0, 0) is the center of the first pixel.
struct PinholeImage {
  double focal_x_px, focal_y_px, per_focal_x, per_focal_y, center_u_px, center_v_px;
  int width_px, height_px;
};

/// Pose of the camera in the frame of the facets.
struct ViewPose {
  double p_m[3];   ///< position of C in W or M
  double R_CW[9];  ///< row-major
};

/// An affine function of the pixel.
struct Affine {
  double right, down, at_origin;

  double at(double u, double v) const { return right * u + down * v + at_origin; }
};

/// A visible facet, set up for one image.
struct Surface {
  Affine w;        ///< 1 / z in C, 1/m
  uint32_t facet;  ///< index in the scene
  uint32_t pose;   ///< index in Frame::poses
};

/// The values that are interpolated over a surface: u and v in 1/256 texel, brightness, and 1. Each is divided by z and
/// thus affine in the pixel. u and v may be shifted by whole repeats of the texture to keep the precision of floats.
struct alignas(32) Interpolants {
  double right[4], down[4], at_origin[4];
};

/// The shadow map as a camera in W sees it: column, row and depth in the map, and an unused value.
struct SunView {
  double at_eye[4];       ///< at the camera position
  Interpolants in_image;  ///< their gradients
};

/// The pixels of a tile that show one surface. The layers of a tile are disjoint.
struct Layer {
  uint64_t pixels;
  float nearest, farthest;  ///< bounds of 1 / z of the surface in this tile, 1/m
  uint32_t surface;         ///< index in Frame::surfaces
};

/// A tile of pixels. One cache line.
struct alignas(64) Tile {
  uint64_t covered;  ///< pixels of the layers, and pixels outside the image
  float farthest;    ///< min 1 / z of the layers, 1/m: they hide surfaces behind it; 0 without layers
  uint16_t count;    ///< of layers
  uint16_t capacity;
  union {
    Layer own[2];    ///< the layers if there are at most two
    uint32_t first;  ///< else the index of the first layer in Frame::pool
  };
};
static_assert(sizeof(Tile) == 64);
inline constexpr uint16_t kOwnLayers = 2;

class FrameMemory;

/// The tiles of an image with their layers, as plain data for the kernels. One grid of tiles for each sample of a
/// pixel.
struct Frame {
  PinholeImage lens;
  int across, down, samples;
  Tile* tiles;  ///< grid by grid, row-major
  ViewPose* poses;
  Surface* surfaces;           ///< with space for the facets of the next call
  Interpolants* interpolants;  ///< of each surface
  size_t surface_count;
  SunView sun;  ///< set with shadows
  Layer* pool;
  FrameMemory* memory;  ///< owner of all arrays
};

inline Layer* layers(const Frame& frame, Tile& tile) {
  return tile.capacity == kOwnLayers ? tile.own : frame.pool + tile.first;
}
inline const Layer* layers(const Frame& frame, const Tile& tile) {
  return tile.capacity == kOwnLayers ? tile.own : frame.pool + tile.first;
}

/// Returns the pixels of a tile that are outside the image.
/// @param columns, rows  of the image, counted from the first pixel of the tile.
inline uint64_t beyond(int columns, int rows) {
  const uint64_t row = columns >= kTilePx ? 0u : 0xffu & (0xffu << columns);
  uint64_t pixels = row * 0x0101010101010101u;
  if (rows < kTilePx) pixels |= ~uint64_t{0} << (kTilePx * rows);
  return pixels;
}

/// Increases the capacity of a full tile. Its layers may move.
void grow(Frame& frame, Tile& tile);

/// Offset of a sample from the center of its pixel, right and down, 1/8 px.
struct SampleOffset {
  int right, down;
};
/// The offsets of one sample, and of four samples as in Mesa's rasterizer.
inline constexpr SampleOffset kOneSample[1] = {{0, 0}};
inline constexpr SampleOffset kFourSamples[4] = {{-1, -3}, {3, -1}, {-3, 1}, {1, 3}};

}  // namespace hedgehop::sim::tiles
