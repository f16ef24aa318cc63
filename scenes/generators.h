#pragma once

#include <cstdint>
#include <variant>

#include "scenes/balloon.h"
#include "scenes/corridor.h"
#include "scenes/forest.h"
#include "scenes/highrise.h"
#include "scenes/park.h"
#include "scenes/room.h"
#include "scenes/scene.h"
#include "scenes/tree.h"
#include "scenes/urban.h"
#include "scenes/wall.h"

namespace hedgehop::scenes {

using SceneConfig = std::variant<UrbanConfig, RoomConfig, TreeConfig, ForestConfig, CorridorConfig, HighriseConfig,
                                 BalloonConfig, WallConfig, ParkConfig>;

/// Returns the scene of `config`: equal arguments give equal scenes, bit for bit.
/// @throws std::invalid_argument naming the field, its value and what is valid.
Scene make_scene(const SceneConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes
