#include "sim/cli/load.h"

namespace hedgehop::sim::cli {

Scenario load(const ScenarioOptions& options) {
  Scenario scenario = load_scenario(options.file, options.overrides);
  if (options.seed) scenario.seed = *options.seed;
  using Context = DrawingConfig::Context;
  if (!options.gl.empty()) scenario.drawing.context = options.gl == "egl" ? Context::egl : Context::osmesa;
  return scenario;
}

}  // namespace hedgehop::sim::cli
