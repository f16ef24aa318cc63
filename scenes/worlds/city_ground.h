#pragma once

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/city_textures.h"
#include "scenes/worlds/urban_plan.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {

/// Ground reaches this far beyond the outer streets: seen from 40 m up, its edge lies a fifth of a degree below the
/// horizon.
inline constexpr double kGroundMarginM = 12000.0;

/// Adds the ground at z = 0: streets on the cells' edges, crossings, a lot in each cell, grass and fields around the
/// city. All panels lie on one grid of lines that crosses the whole plane, so that no corner meets the middle of an
/// edge.
void add_city_ground(const UrbanPlan& plan, const textures::CityTextures& city, uint64_t seed, mesh::MeshBuilder& mesh);

}  // namespace hedgehop::scenes::worlds
