#include "sim/flight/build.h"

#include "sim/flight/build_identity.h"

namespace hedgehop::sim {

std::string_view version() { return HEDGEHOP_VERSION; }
std::string_view build_identity() { return HEDGEHOP_BUILD; }

}  // namespace hedgehop::sim
