#pragma once

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/city_textures.h"
#include "scenes/worlds/urban.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {

/// Width of the ground beyond the outer streets. From an altitude of 40 m its edge appears 0.2 degrees below the
/// horizon.
inline constexpr double kGroundMarginM = 12000.0;

/// Adds the ground at z = 0: streets along the cells' edges, crossings, a lot in each cell, grass and fields around the
/// city. All panels lie on one grid of lines across the plane, so that no corner lies in the interior of an edge.
/// @param wear  whether streets and crossings have repairs that differ from place to place.
void add_city_ground(const UrbanPlan& plan, const textures::CityTextures& city, uint64_t seed, bool wear,
                     mesh::MeshBuilder& mesh);

/// Adds a building with one chunk per box: shops on the ground floor, complete windows, a cornice and a roof. Random
/// choices are the style of the walls and, for each face, the part and the variant of the textures.
/// @param wear  if not null, chooses the windows of each floor and span of bays, so that no two facades are equal.
void add_building(const Building& building, const textures::CityTextures& city, Random& random, Random* wear,
                  mesh::MeshBuilder& mesh);

}  // namespace hedgehop::scenes::worlds
