#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "avoidance/module.h"
#include "sim/loop/ticks.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Returns the module of a flight. If the scenario has a takeover, the returned module combines both modules.
/// If a module fails while it is loaded (ModuleFault), the returned module fails at its first decision.
/// @param module  of the scenario; null for a foreign module, which is loaded. @param folder  as of make_module().
/// Throws InputError if a module cannot be loaded, or if the two modules need different cameras.
std::unique_ptr<avoidance::Module> make_active_module(const Scenario& scenario, const Ticks& ticks,
                                                      std::unique_ptr<avoidance::Module> module,
                                                      const std::filesystem::path& folder = {});

/// Returns a module that decides like `before` until an instant and like `after` from then on. Both receive every
/// observation from the start, so `after` has the same history. If both are equal, the flight is bit-identical to a
/// flight with one of them. @param at_ns  `after` makes its first decision at this time or the next time one is due.
/// Throws std::invalid_argument if they need different cameras.
std::unique_ptr<avoidance::Module> make_takeover(std::unique_ptr<avoidance::Module> before,
                                                 std::unique_ptr<avoidance::Module> after, int64_t at_ns);

}  // namespace hedgehop::sim
