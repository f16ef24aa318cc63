#pragma once

#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Evaluates a scenario's checks on a flight that has ended, in the order of the scenario; NoCollisionCheck once, last
/// where the scenario does not list it, and not at all where it may collide. Empty means that nothing was asked.
/// @param scene           the scene that was flown.
/// @param rotor_radius_m  radius of the disc that covers floor cells, > 0.
std::vector<CheckResult> evaluate_checks(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                         double rotor_radius_m);

/// Share of the square cells of a plan whose centers a disc has covered while its center moved along a path, 0..1.
/// @param plan_NE_m  north, east extent; cells start at its south-west corner, those cut by the far edges count too.
/// @param path_NE_m  positions dense enough to stand for the curve.
double visited_share(const Eigen::AlignedBox2d& plan_NE_m, double cell_m, const std::vector<Eigen::Vector2d>& path_NE_m,
                     double disc_radius_m);

}  // namespace hedgehop::sim
