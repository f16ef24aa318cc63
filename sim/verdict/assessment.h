#pragma once

#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Adds to the result of a flight the scene's difficulty figures, the metrics of the field and the scenario's checks,
/// all computed from the record.
void assess(const Scenario& scenario, const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
            Flight& flight);

/// Evaluates the checks of a scenario on a completed flight, in the order of the scenario. NoCollisionCheck is
/// evaluated once: last if the scenario does not list it, never if the scenario sets `may_collide`. An empty result
/// means that the flight has no checks.
/// @param scene           the scene of the flight.
/// @param rotor_radius_m  radius of the disc that covers floor cells, > 0.
std::vector<CheckResult> evaluate_checks(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                         double rotor_radius_m);

}  // namespace hedgehop::sim
