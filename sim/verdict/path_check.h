#pragma once

#include "sim/flight/flight.h"
#include "sim/scenario/checks.h"

namespace hedgehop::sim {

/// Returns the result of a path check. The cause of a failure states the time and place at which the flight left the
/// path.
CheckResult evaluate_path(const PathToleranceCheck& check, const Flight& flight);

}  // namespace hedgehop::sim
