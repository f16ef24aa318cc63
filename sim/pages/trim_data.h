#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "dynamics/steady_flight.h"

namespace hedgehop::sim {

/// Level flight in trim at one speed.
struct TrimPoint {
  double speed_mps = 0.0;  ///< forwards through the air
  dynamics::SteadyFlight flight;
};

/// All that the page of a vehicle's trim draws: a plot over speed for each group of quantities of one unit.
/// @param points       of one vehicle, at least one, by rising speed.
/// @param missing_mps  speeds at which there is no trim; the page lists them.
nlohmann::ordered_json trim_data(const std::string& vehicle, const std::vector<TrimPoint>& points,
                                 const std::vector<double>& missing_mps);

}  // namespace hedgehop::sim
