#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/tiles/facet.h"
#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/sun_blocks.h"

namespace hedgehop::sim::tiles {

inline constexpr int kMostLevels = 16;

/// Textures at all their sizes, texture by texture, each from its largest size to one texel: plain data, for kernels.
/// Levels are 128 less than they are. A row has one place more than texels, which holds the first once again.
struct Texels {
  /// A texel and, in the upper byte, the one below: thirty-two bits from a place on are four neighbors.
  const uint16_t* greys;
  const uint32_t* colors;  ///< R, G, B from the lowest byte on
};

/// How the places of a texture lie.
struct TextureLayout {
  int size_px, size_log2, last_level;
  size_t places;               ///< of a texture
  int32_t first[kMostLevels];  ///< place of each level
};

/// Where the sun shines: the depth of what stands still, seen from the sun, 1 nearest to it and 0 farthest, in a border
/// of one farthest texel.
struct SunDepths {
  const float* depths;  ///< null without shadows
  int texels;           ///< a side, the border aside
  double from_W[3][4];  ///< from p_W, m: column and row of a texel, from the middle of the first, and depth
  float ambient;        ///< share of the albedo that the sun has no part in
  SunBlocks blocks;     ///< of the depths with their border
};

/// RGB or, in the first, grey; levels 0..255.
struct SkyColors {
  float horizon[3], zenith[3];
};

/// A scene as kernels read it.
struct SceneView {
  const FacetShape* shapes;
  FacetPlanes planes_of_facets;
  const FacetCover* covers;
  TextureLayout layout;
  Texels texels;  ///< greys or colors, whatever is drawn
  SkyColors sky;
  SunDepths sun;
  Eye world;  ///< of the image
};

}  // namespace hedgehop::sim::tiles
