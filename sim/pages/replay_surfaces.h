#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// Returns the visible surfaces of a scene for the replay (web/src/replay_world.js): `lights`, `sky`, `textures` (JPEG
/// in base64) and `meshes`: the fixed one, then one per mover in M. A mesh has `count` corners and arrays in base64,
/// little-endian: `p` (uint16, from `low` in steps of `step`, m), `uv` (float32), `n` (int8), `texture` (uint16) and
/// `index` (uint32). Scenes of many triangles have the detail of distant chunks.
/// @param shadows  whether the simulator draws shadows in this flight.
nlohmann::ordered_json replay_surfaces(const scenes::Scene& scene, bool shadows);

}  // namespace hedgehop::sim
