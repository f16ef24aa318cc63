#pragma once

#include <cstdint>
#include <memory>

#include "avoidance/module.h"

namespace hedgehop::sim {

/// Makes a module that decides as `before` does until an instant, and from then on as `after` does. Both get every
/// observation from the start, so that whoever takes over has seen what the other saw. With two equal ones the flight
/// is that of one, bit for bit.
/// @param at_ns  the first decision of `after` is at this time or the next that is due.
/// Throws std::invalid_argument when they do not need the same cameras.
std::unique_ptr<avoidance::Module> make_takeover(std::unique_ptr<avoidance::Module> before,
                                                 std::unique_ptr<avoidance::Module> after, int64_t at_ns);

}  // namespace hedgehop::sim
