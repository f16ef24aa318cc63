#include "sim/scenario/drawing.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

namespace {

DrawingConfig::Context context_from_environment() {
  using enum DrawingConfig::Context;
  const char* const variable = std::getenv("HEDGEHOP_GL");
  const std::string name = variable == nullptr ? "" : variable;
  if (name.empty() || name == "osmesa") return osmesa;
  if (name == "egl") return egl;
  if (name == "tiles") return tiles;
  throw InputError(
      fmt::format("environment variable HEDGEHOP_GL: '{}' draws nothing; valid: osmesa, egl, tiles", name));
}

}  // namespace

DrawingConfig::Context DrawingConfig::usual_context() {
  static const Context context = context_from_environment();
  return context;
}

}  // namespace hedgehop::sim
