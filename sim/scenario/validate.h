#pragma once

#include <optional>

#include "sim/config/tree.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

/// Builds the parts of a scenario, and adds a fault for each thing that does not fit another or that a part refuses.
/// @param root  what the scenario was read from, for the places.
/// @return the parts; none when one cannot be built, with a fault added.
std::optional<FlightParts> validate(const Scenario& scenario, const Node& root, Faults& faults);

}  // namespace hedgehop::sim
