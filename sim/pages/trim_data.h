#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "dynamics/steady_flight.h"

namespace hedgehop::sim {

/// Level flight in trim at one speed.
struct TrimPoint {
  double speed_mps = 0.0;  ///< forward airspeed
  dynamics::SteadyFlight flight;
};

/// Returns the data of the trim page: a plot over speed for each group of quantities with one unit.
/// @param points       of one vehicle, at least one, in the order of speed.
/// @param missing_mps  speeds without a trim, which the page lists.
nlohmann::ordered_json trim_data(const std::string& vehicle, const std::vector<TrimPoint>& points,
                                 const std::vector<double>& missing_mps);

}  // namespace hedgehop::sim
