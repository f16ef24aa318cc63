#pragma once

#include "sim/cli/commands.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim::cli {

/// Returns the scenario of a command line with overrides and seed applied, and its parts. Throws InputError.
LoadedScenario load(const ScenarioOptions& options);

}  // namespace hedgehop::sim::cli
