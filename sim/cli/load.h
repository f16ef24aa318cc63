#pragma once

#include "sim/cli/commands.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {

/// The scenario of a command line, its overrides and seed applied. Throws InputError.
Scenario load(const ScenarioOptions& options);

}  // namespace hedgehop::sim::cli
