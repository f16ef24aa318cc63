#pragma once

#include "scenes/city_pictures.h"
#include "scenes/mesh_builder.h"
#include "scenes/random.h"
#include "scenes/urban_plan.h"

namespace hedgehop::scenes {

/// Adds a building, one chunk per box: shops at its foot, whole windows up the walls, a cornice, a roof. The style of
/// its walls, and for each face the part of the pictures and their variants, are drawn from `random`.
void add_building(const Building& building, const CityPictures& city, Random& random, MeshBuilder& mesh);

}  // namespace hedgehop::scenes
