#include "sim/cli/load.h"

namespace hedgehop::sim::cli {

LoadedScenario load(const ScenarioOptions& options) {
  LoadedScenario loaded = load_flight(options.file, options.overrides, options.seed);
  using Context = DrawingConfig::Context;
  if (!options.gl.empty()) loaded.scenario.drawing.context = options.gl == "egl" ? Context::egl : Context::osmesa;
  return loaded;
}

}  // namespace hedgehop::sim::cli
