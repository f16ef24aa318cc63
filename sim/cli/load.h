#pragma once

#include <string>
#include <vector>

#include "sim/cli/commands.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim::cli {

/// Returns the scenario of a command line with overrides and seed applied, and its parts. Throws InputError.
inline LoadedScenario load(const ScenarioOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.renderer.empty()) overrides.push_back("drawing.renderer=" + options.renderer);
  return load_flight(options.file, overrides, options.seed);
}

}  // namespace hedgehop::sim::cli
