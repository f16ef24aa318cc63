#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/falsify/falsify.h"

namespace hedgehop::sim {

/// Flies one order; nothing when it was interrupted. An earlier result of the same order is reused.
using FlyOne = std::function<std::optional<FlightRecord>(const Order& order)>;

/// The least of a failing flight that still fails.
struct Shrunk {
  Scenario scenario;
  FlightRecord record;                 ///< of its flight
  size_t trials = 0;                   ///< flights that it took
  size_t items_before = 0, items = 0;  ///< boxes, movers and failures
  bool stopped = false;                ///< by `fly`, before it was done
};

/// Shrinks a flight in which a check fails to one in which the same check fails: leaves out boxes, movers and failures
/// (ddmin); moves each unknown towards its neutral value, by halves; ends the flight a second after the failure; rounds
/// the unknowns to the fewest decimals. Failing is not monotone in a number, so that nothing is claimed of a boundary.
/// @param failure  of the search's result. @param folder  for the trials' scenarios. @param most_trials  flights.
Shrunk shrink(const FalsifySearch& search, const FalsifyTrial& failure, const FlightRecord& record,
              const std::filesystem::path& folder, size_t most_trials, const FlyOne& fly);

/// An order for a scenario's file. Throws InputError for what the scenario refuses.
Order file_order(const std::filesystem::path& file, const std::string& id);

}  // namespace hedgehop::sim
