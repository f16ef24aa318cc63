#pragma once

#include <cstdint>

#include "sim/flight/flight.h"
#include "sim/scenario/checks.h"

namespace hedgehop::sim {

/// Returns the result of a path check. The cause of a failure states the time and place at which the flight left the
/// path, and the seed and version of the reference if the flight has others. @param seed  of the flight.
CheckResult evaluate_path(const PathToleranceCheck& check, const Flight& flight, uint64_t seed);

}  // namespace hedgehop::sim
