#include <sleef.h>

#include "sim/libm/libm.h"

namespace hedgehop::sim {

std::string libm_version() {
  return "SLEEF " + std::to_string(SLEEF_VERSION_MAJOR) + "." + std::to_string(SLEEF_VERSION_MINOR) + "." +
         std::to_string(SLEEF_VERSION_PATCHLEVEL);
}

}  // namespace hedgehop::sim
