#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Returns the map of a module and the truth for map.json and the report. Frame W, m:
/// `points` {n, e, d, covariance: [nn, ne, ee], true} (covariance seen from above, m^2; true is null if the corners of
/// the scene are unknown), `corners` {n, e, d, counts, found}, `course` [[n, e]...], `paths` {t, places: [[n, e]...]}.
nlohmann::ordered_json map_data(const MapRecord& map);

}  // namespace hedgehop::sim
