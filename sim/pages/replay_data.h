#pragma once

#include <nlohmann/json_fwd.hpp>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/record/table.h"

namespace hedgehop::sim {

/// Returns a scene for the replay (web/src/replay.js). Coordinates are in W, those of moving obstacles in M; lengths in
/// m. Bodies are lists of numbers: `boxes`, `cylinders`, `spheres` of position, quaternion (x, y, z, w) and half
/// extents; `meshes` of corners and faces. `movers` have bodies and `way`, their positions every `step_s` from 0 to the
/// end. `labels` are names of solids, each with the position above its center.
/// @param end_s  of the flight, >= 0.
nlohmann::ordered_json replay_scene(const scenes::Scene& scene, double end_s);

/// Returns the hull of the vehicle as such bodies, in B.
nlohmann::ordered_json replay_hull(const std::vector<dynamics::HullPart>& hull);

/// Returns the changes of the module status as [t_s, status]. Throws std::runtime_error if the table lacks a column.
nlohmann::ordered_json replay_statuses(const Table& decisions);

/// Returns the flight: true position, attitude (rad, 3-2-1), clearance and speed at most `max_rows` evenly
/// spaced rows of the trajectory, including the last one. Throws std::runtime_error if the table lacks a column.
nlohmann::ordered_json replay_path(const Table& trajectory, size_t max_rows = 6000);

}  // namespace hedgehop::sim
