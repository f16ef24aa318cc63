#pragma once

#include <cstdint>

namespace hedgehop::sim::tiles {

/// A convex planar polygon of three or four corners, the last one twice for three; counter-clockwise seen from outside.
/// Plain data, as all that kernels read. In W, or in M of a mover.
struct FacetShape {
  float x_m[4], y_m[4], z_m[4];  ///< of the corners
};

/// The planes of facets, number by number: n . p = offset, n the outward unit normal.
struct FacetPlanes {
  const float *n_x, *n_y, *n_z, *offset_m;  ///< with room to read seven more
};

/// What a facet looks like. Texture coordinates u and v, in repeats, and brightness, a share of the albedo, are affine
/// over its plane. Fills a line of the cache.
struct alignas(64) FacetCover {
  uint32_t texture;
  int32_t label;
  bool evenly_lit;   ///< brightness has no gradient
  float values[13];  ///< u, v, brightness at the first corner; their gradients along x, y and z, 1/m; and a spare one

  float brightness() const { return values[2]; }
};
static_assert(sizeof(FacetCover) == 64);

}  // namespace hedgehop::sim::tiles
