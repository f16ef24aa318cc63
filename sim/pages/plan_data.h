#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/pages/plan.h"

namespace hedgehop::sim {

/// What MapView (web/src/map.js) draws: `bounds` [north, north, east, east] or [], `footprints`, `movers`; places in m.
/// @param lowest_m, highest_m  altitudes between which was flown; they decide which solids are beside the flight.
nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m);

}  // namespace hedgehop::sim
