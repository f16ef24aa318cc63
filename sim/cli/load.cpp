#include "sim/cli/load.h"

namespace hedgehop::sim::cli {

LoadedScenario load(const ScenarioOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.gl.empty()) overrides.push_back("drawing.context=" + options.gl);
  return load_flight(options.file, overrides, options.seed);
}

}  // namespace hedgehop::sim::cli
