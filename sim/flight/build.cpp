#include "sim/flight/build.h"

#include "sim/flight/build_identity.h"

namespace hedgehop::sim {

std::string_view version() { return HEDGEHOP_VERSION; }
std::string_view build_identity() { return HEDGEHOP_BUILD; }
std::string_view build_commit() { return HEDGEHOP_COMMIT; }
std::string_view build_compiler() { return HEDGEHOP_COMPILER; }

}  // namespace hedgehop::sim
