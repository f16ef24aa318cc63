#pragma once

#include <string>
#include <vector>

#include "scenes/map/building.h"
#include "scenes/map/ground.h"
#include "scenes/map/town_textures.h"
#include "scenes/mesh/mesh_builder.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::map {

/// Adds a building: an instance and a chunk with its walls, windows and roof, and solids that fill it. Its foot is at
/// the lowest corner of its outline on the ground.
/// @param[out] faults  receives a line if the building is not complete.
void add_map_building(const MapBuilding& building, const Ground& ground, const TownTextures& town, Random& random,
                      mesh::MeshBuilder& mesh, std::vector<Solid>& solids, std::vector<std::string>& faults);

}  // namespace hedgehop::scenes::map
