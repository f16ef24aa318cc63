#pragma once

#include <memory>

#include "avoidance/module.h"
#include "sim/scenario/avoidance_config.h"

namespace hedgehop::sim {

/// Makes the module that decides where to fly, loading its library when it comes from outside. Such a module's every
/// call is guarded (call_guard.h): one that crashed or hung is never called again, and says so.
/// Throws std::invalid_argument on a bad config of a module of this tree, and InputError naming the library when it is
/// missing or none, was built against another interface, lacks the module, or refuses its parameters.
std::unique_ptr<avoidance::Module> make_module(const AvoidanceConfig& config);

}  // namespace hedgehop::sim
