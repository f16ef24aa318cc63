#pragma once

#include <cstdint>
#include <vector>

#include "scenes/map/streets.h"

namespace hedgehop::scenes::map {

/// Adds cars as movers. Each drives to and fro in the right lane of a straight piece of a street, along the ground.
/// @param count  of cars; fewer if the map has too few straight pieces. @param max_speed_mps  each drives at 60 to 100
/// %.
/// @param town  textures, which the movers share with the scene. @param seed  of their places.
void add_traffic(const std::vector<Street>& streets, const Ground& ground, const TownTextures& town, int64_t count,
                 double max_speed_mps, uint64_t seed, std::vector<Mover>& movers);

}  // namespace hedgehop::scenes::map
