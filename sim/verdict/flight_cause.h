#pragma once

#include <string>

#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Returns one sentence on a flight that ended before its goal: the last statuses and commands of the module, the
/// covered part of the way, and the nearest obstacle at the end.
std::string missed_goal_words(const Scenario& scenario, const Flight& flight);

/// Returns the covered and the whole horizontal length of the way over the waypoints to the goal, m; the covered part
/// is less than 0 if the flight ends farther away than it began.
struct CoveredWay {
  double covered_m = 0.0, whole_m = 0.0;
};
CoveredWay covered_way(const Scenario& scenario, const Flight& flight);

/// Sets FlightResult::goal_missed_unchecked, and FlightResult::cause unless the loop has set it.
void explain(const Scenario& scenario, Flight& flight);

}  // namespace hedgehop::sim
