#pragma once

#include <set>
#include <string>
#include <vector>

#include "sim/batch/record.h"

/// Checks before the flights of a batch.
namespace hedgehop::sim::cli {

/// Assembles the scene, the vehicle and the module of a flight, because some errors show only there. Returns the
/// remarks on the files of its scene. Throws InputError.
std::set<std::string> require_flyable(const Order& order);

/// An OrderCheck: calls require_flyable() for scenarios with a module from outside, which a process of its own loads.
void require_flyable_foreign(const Scenario& scenario, const Order& order);

/// Calls require_flyable_foreign() for the first of the orders: before the first flight of a sweep or a search.
void require_first_flyable(const std::vector<Order>& orders);

}  // namespace hedgehop::sim::cli
