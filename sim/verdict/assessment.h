#pragma once

#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Adds to a flown flight's result what follows from the record alone: how difficult the scene was, the field's
/// metrics, and the scenario's checks.
void assess(const Scenario& scenario, const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
            Flight& flight);

}  // namespace hedgehop::sim
