#pragma once

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/city_textures.h"
#include "scenes/worlds/urban_plan.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::mesh {

/// Adds a building, one chunk per box: shops at its foot, whole windows up the walls, a cornice, a roof. The style of
/// its walls, and for each face the part of the images and their variants, are drawn from `random`.
void add_building(const worlds::Building& building, const textures::CityTextures& city, Random& random,
                  MeshBuilder& mesh);

}  // namespace hedgehop::scenes::mesh
