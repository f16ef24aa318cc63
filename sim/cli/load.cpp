#include "sim/cli/load.h"

namespace hedgehop::sim::cli {

LoadedScenario load(const ScenarioOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.renderer.empty()) overrides.push_back("drawing.renderer=" + options.renderer);
  return load_flight(options.file, overrides, options.seed);
}

}  // namespace hedgehop::sim::cli
