#pragma once

#include "sim/reproduce/calculations.h"

/// The thesis's flights from projected corners, seed 1, each with both starts of landmarks.
namespace hedgehop::sim {

/// Error against time: `t_s`; the mean over all coordinates, `ground_percent` and `inverse_depth_percent`; and of one
/// corner begun on the ground `sample_north_percent`, `sample_east_percent`, `sample_altitude_percent`, with their
/// signs. Source: [Shah2009] fig. 6.1.
std::vector<std::string> landmark_error_columns();
Columns cube_lateral_errors();
Columns highrise_lateral_errors();
Columns highrise_forward_errors();

/// The map as the outlines of the towers between its landmarks, begun on the ground: `true_north_m`, `true_east_m`,
/// `true_altitude_m`, and the same of `early_` (first image), `middle_` and `late_` (end). NaN between two edges.
/// Source: [Shah2009] fig. 4.5, fig. 4.6 and fig. 5.1.
std::vector<std::string> landmark_map_columns();
Columns cube_lateral_map();
Columns highrise_lateral_map();
Columns highrise_forward_map();

}  // namespace hedgehop::sim
