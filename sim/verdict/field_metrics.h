#pragma once

#include <vector>

#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Figures that make flights of different modules comparable; docs/metrics.md defines each. They come from the true
/// path alone, never from wall time. A figure that a flight does not have (no goal, nothing near) is left out.
/// @param vehicle_radius_m  of the smallest vertical cylinder round the hull, > 0.
std::vector<MetricValue> field_metrics(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                       double vehicle_radius_m);

}  // namespace hedgehop::sim
