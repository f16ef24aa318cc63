#pragma once

#include <string>

#include "sim/flightlog/log_comparison.h"

namespace hedgehop::sim {

/// Returns a figure (SVG) of the errors of velocity, attitude and rates, and of the position if the logs have it,
/// against the horizon: of the model and of the simple predictions.
std::string log_figure(const LogComparison& comparison);

}  // namespace hedgehop::sim
