#include "sim/cli/load.h"

namespace hedgehop::sim::cli {

Scenario load(const ScenarioOptions& options) {
  Scenario scenario = load_scenario(options.file, options.overrides);
  if (options.seed) scenario.seed = *options.seed;
  return scenario;
}

}  // namespace hedgehop::sim::cli
