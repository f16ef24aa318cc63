#pragma once

#include <vector>

#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/huge_pages.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// Returns the shadow map of plan_sun_map() without blocks. @param depths  memory of the result.
SunDepths draw_sun_depths(const SceneGeometry& geometry, const scenes::Lights& lights, HugeVector<float>& depths);

/// Returns the blocks of a shadow map.
/// @param depths  of the map with its border, which is column and row -1. @param stride  texels per side.
/// @param blocks  memory of the result.
SunBlocks make_sun_blocks(const float* depths, int stride, std::vector<SunBlock> (&blocks)[SunBlocks::kLevels]);

}  // namespace hedgehop::sim::tiles
