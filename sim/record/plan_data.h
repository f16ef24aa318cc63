#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/record/plan.h"

namespace hedgehop::sim {

/// A number short enough for an image, five figures; null when it is not finite.
nlohmann::ordered_json brief(double value);
/// A place or an instant, to the millimeter or millisecond; null when it is not finite.
nlohmann::ordered_json milli(double value);

/// What MapView (web/src/map.js) draws: `bounds` [north, north, east, east] or [], `footprints`, `movers`; places in m.
/// @param lowest_m, highest_m  altitudes between which was flown; they decide which solids are beside the flight.
nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m);

}  // namespace hedgehop::sim
