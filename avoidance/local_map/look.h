#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/local_map/footprint.h"
#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Whether a place is within the slice, and unknown.
bool is_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W);

/// The unknown cell nearest to where a path that ignores the unknown first comes too near to one; nothing where it
/// never does. @param hull_m  radius of the vehicle: how far around that place is searched.
std::optional<Eigen::Vector2d> unknown_in_the_way(const LevelSlice& slice, const Footprint& footprint,
                                                  const std::vector<Moment>& path, double hull_m);

/// Whether the nose points at a place, within 20 degrees. @param heading_rad  of the nose, from north to east.
bool points_at(const Eigen::Vector2d& place_W, const Eigen::Vector2d& p_W, double heading_rad);

}  // namespace hedgehop::avoidance::local_map
