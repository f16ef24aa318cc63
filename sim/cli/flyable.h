#pragma once

#include <set>
#include <string>

#include "sim/batch/record.h"

/// Checks before the flights of a batch.
namespace hedgehop::sim::cli {

/// Assembles the scene, the vehicle and the module of a flight, because some errors show only there. Returns the
/// remarks on the files of its scene. Throws InputError.
std::set<std::string> require_flyable(const Order& order);

/// An OrderCheck: calls require_flyable() for scenarios with a module from outside, which a process of its own loads.
void require_flyable_foreign(const Scenario& scenario, const Order& order);

}  // namespace hedgehop::sim::cli
