#pragma once

#include "sim/render/tiles/huge_pages.h"

#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// Draws what plan_sun_map() plans. @param depths  what the result points into.
SunDepths draw_sun_depths(const SceneGeometry& geometry, const scenes::Lights& lights, HugeVector<float>& depths);

}  // namespace hedgehop::sim::tiles
