#pragma once

#include <cstdint>
#include <variant>

#include "scenes/scene.h"
#include "scenes/worlds/balloon.h"
#include "scenes/worlds/calibration_board.h"
#include "scenes/worlds/corridor.h"
#include "scenes/worlds/highrise.h"
#include "scenes/worlds/map.h"
#include "scenes/worlds/open.h"
#include "scenes/worlds/park.h"
#include "scenes/worlds/room.h"
#include "scenes/worlds/trees.h"
#include "scenes/worlds/urban.h"
#include "scenes/worlds/wall.h"

namespace hedgehop::scenes {

using SceneConfig = std::variant<worlds::UrbanConfig, worlds::RoomConfig, worlds::TreeConfig, worlds::ForestConfig,
                                 worlds::CorridorConfig, worlds::HighriseConfig, worlds::BalloonConfig,
                                 worlds::WallConfig, worlds::ParkConfig, worlds::OpenConfig, worlds::MapConfig,
                                 worlds::CheckerboardConfig, worlds::AprilGridConfig>;

/// Returns the scene of `config`. Equal arguments give scenes that are equal bit for bit.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_scene(const SceneConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes
