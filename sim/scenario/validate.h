#pragma once

#include "sim/scenario/scenario.h"
#include "sim/scenario/tree.h"

namespace hedgehop::sim {

/// Adds a fault for each thing that does not fit another, or that a part refuses when it is built.
/// @param root  what the scenario was read from, for the places.
void validate(const Scenario& scenario, const Node& root, Faults& faults);

}  // namespace hedgehop::sim
