#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/falsify/falsify.h"

namespace hedgehop::sim {

/// Flies one order; returns nullopt if interrupted. An earlier result of the same order is reused.
using FlyOne = std::function<std::optional<FlightRecord>(const Order& order)>;

/// The simplest variant of a failing flight that still fails.
struct Shrunk {
  Scenario scenario;
  FlightRecord record;                 ///< of the flight
  size_t trials = 0;                   ///< flights of the shrinking
  size_t items_before = 0, items = 0;  ///< boxes, movers and failures
  bool stopped = false;                ///< by `fly`, before shrinking ended
};

/// Shrinks a failing flight to a simpler one in which the same check fails. It removes boxes, movers and failures
/// (ddmin), moves each unknown towards its neutral value by bisection, ends the flight one second after the failure and
/// rounds the unknowns to as few decimals as possible. Values remain in their ranges, except neutral ones, and the
/// remaining boxes satisfy the constraints. Failing need not be monotone in a parameter, so the result is no
/// statement about a boundary.
/// @param failure  of the search's result. @param folder  for the trials' scenarios. @param max_trials  flights.
Shrunk shrink(const FalsifySearch& search, const FalsifyTrial& failure, const FlightRecord& record,
              const std::filesystem::path& folder, size_t max_trials, const FlyOne& fly);

/// Returns the order of a scenario file. Throws InputError if the scenario is invalid.
Order file_order(const std::filesystem::path& file, const std::string& id);

}  // namespace hedgehop::sim
