#pragma once

#include <nlohmann/json_fwd.hpp>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/record/column_table.h"

namespace hedgehop::sim {

/// What the replay's script (web/src/replay.js) builds of a scene. Everything is in W, movers in M; lengths in m.
/// Bodies are lists of numbers: `boxes`, `cylinders`, `spheres` of position, quaternion (x, y, z, w) and half extents;
/// `meshes` of corners and faces. `movers` have bodies and `way`, their place at `step_s` apart from 0 to the end.
/// `labels` are names of solids, each with the place above its middle.
/// @param end_s  of the flight, >= 0.
nlohmann::ordered_json replay_scene(const scenes::Scene& scene, double end_s);

/// The vehicle's hull as such bodies, in B.
nlohmann::ordered_json replay_hull(const std::vector<dynamics::HullPart>& hull);

/// What the module said, as [t_s, status] since when. Throws std::runtime_error when the table lacks a column.
nlohmann::ordered_json replay_statuses(const ColumnTable& decisions);

/// The flight: true position, attitude (rad, 3-2-1), clearance and speed at no more than `max_rows` rows of the
/// trajectory, evenly spaced, the last one among them. Throws std::runtime_error when the table lacks a column.
nlohmann::ordered_json replay_path(const ColumnTable& trajectory, size_t max_rows = 6000);

}  // namespace hedgehop::sim
