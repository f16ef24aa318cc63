#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/tiles/frame.h"

// A scene as the kernels read it: plain data.
namespace hedgehop::sim::tiles {

/// A convex planar polygon with three or four corners, counter-clockwise seen from outside. If it has three, the last
/// corner is given twice. In W, or in M for a moving obstacle.
struct FacetShape {
  float x_m[4], y_m[4], z_m[4];  ///< of the corners
};

/// The planes of all facets, one array per component: n . p = offset, n the outward unit normal.
struct FacetPlanes {
  const float *n_x, *n_y, *n_z, *offset_m;  ///< with seven more readable elements
};

/// The appearance of a facet. Texture coordinates u and v, in repeats, and brightness, a share of the albedo, are
/// affine over its plane. One cache line.
struct alignas(64) FacetAttributes {
  uint32_t texture;
  int32_t label;
  bool evenly_lit;   ///< brightness has no gradient
  float values[13];  ///< u, v, brightness at the first corner; their gradients along x, y and z, 1/m; one unused value

  float brightness() const { return values[2]; }
};
static_assert(sizeof(FacetAttributes) == 64);

inline constexpr int kMaxLevels = 16;

/// Textures at all sizes: texture by texture, each from the largest size to one texel. Stored levels are 128 less than
/// the actual ones. Each row has one position more than texels; the last position repeats the first texel.
struct Texels {
  /// A texel and, in the upper byte, the texel below it. 32 bits from a position are thus four neighboring texels.
  const uint16_t* greys;
  const uint32_t* colors;  ///< R, G, B from the lowest byte
};

/// Positions of the texels of one texture.
struct TextureLayout {
  int size_px, size_log2, last_level;
  size_t positions;           ///< positions per texture
  int32_t first[kMaxLevels];  ///< first position of each level
};

/// Bounds of the depths in a block of the shadow map. All depths are at least `min_depth`. The depth of column x and
/// row y is at most max_offset + right * x + down * y, which is a tight bound if the block shows one plane.
struct SunBlock {
  float min_depth, max_offset, right, down;
};

/// Blocks of the shadow map, level by level. The side of the blocks doubles with each level. A few blocks are
/// sufficient to decide whether a region is completely lit or completely in shadow.
struct SunBlocks {
  static constexpr int kLevels = 6;
  static constexpr int kFirstLog2 = 3;  ///< log2 of the side of the blocks of the first level, texels

  const SunBlock* levels[kLevels];
  int across[kLevels];  ///< blocks per row
};

/// The shadow map: depths of all static solids seen from the sun, from 1 (at the sun side) to 0 (at the far side), with
/// a border of one texel of depth 0.
struct SunDepths {
  const float* depths;  ///< null without shadows
  int texels;           ///< per side, without the border
  double from_W[3][4];  ///< transformation from p_W, m: column and row from the center of the first texel, and depth
  float ambient;        ///< share of the albedo that does not come from the sun
  SunBlocks blocks;     ///< of the depths with their border
};

/// RGB, or grey in the first element; levels 0..255.
struct SkyColors {
  float horizon[3], zenith[3];
};

struct SceneView {
  const FacetShape* shapes;
  FacetPlanes planes_of_facets;
  const FacetAttributes* attributes;
  TextureLayout layout;
  Texels texels;  ///< the one that the current image needs, greys or colors
  SkyColors sky;
  SunDepths sun;
  ViewPose world;  ///< pose of the camera in W
};

}  // namespace hedgehop::sim::tiles
