#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "sim/flight/flight.h"
#include "sim/flight/flight_watcher.h"
#include "sim/render/renderer.h"
#include "sim/scenario/flight_parts.h"

/// Where a scenario becomes a flight: the loop simulates it, the verdict judges it.
namespace hedgehop::sim {

/// Flies a scenario to its end and judges the flight. Equal scenarios give equal flights, bit for bit, the wall-time
/// fields aside. Throws InputError for what only the assembled parts show (a scene that cannot be, a vehicle that
/// cannot hover); a fault in flight is an outcome, not an exception.
/// @param parts  of the scenario, not flown yet. @param watcher  may be null.
Flight fly(const Scenario& scenario, FlightParts parts, FlightWatcher* watcher = nullptr);
/// As above, for a scenario that no file was read for: builds the parts first.
Flight fly(const Scenario& scenario, FlightWatcher* watcher = nullptr);

/// Returns what one camera of the rig sees in a flight, drawn as `channel` whatever the rig's own is.
/// @param role   of the camera. InputError lists the rig's roles when it has no such camera.
/// @param t_s    time of the image, >= 0. The flight is simulated up to it, and for Channel::flow up to the camera's
///               next image. InputError when the flight ends before.
cv::Mat image_at(const Scenario& scenario, FlightParts parts, std::string_view role, Channel channel, double t_s);
cv::Mat image_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s);

}  // namespace hedgehop::sim
