#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// A module's map beside the truth, as map.json has it and the report's script draws it. Frame W, m:
/// `points` {n, e, d, covariance: [nn, ne, ee], true} (covariance seen from above, m^2; true is null where the scene's
/// corners are unknown), `corners` {n, e, d, counts, found}, `course` [[n, e]...], `paths` {t, places: [[n, e]...]}.
nlohmann::ordered_json map_data(const MapRecord& map);

}  // namespace hedgehop::sim
