#pragma once

#include <cstdint>
#include <variant>

#include "scenes/room.h"
#include "scenes/scene.h"
#include "scenes/urban.h"

namespace hedgehop::scenes {

using SceneConfig = std::variant<UrbanConfig, RoomConfig>;

/// Returns the scene of `config`: equal arguments give equal scenes, bit for bit.
/// @throws std::invalid_argument naming the field, its value and what is valid.
Scene make_scene(const SceneConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes
