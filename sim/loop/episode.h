#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "sim/flight/flight.h"
#include "sim/loop/watcher.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Flies a scenario to its end. Equal scenarios give equal flights, bit for bit, the wall-time fields aside.
/// Throws InputError for a value out of its bounds and for what only the assembled parts can tell (a module without its
/// camera, a vehicle that cannot hover); a fault in flight is an outcome, not an exception.
Flight fly(const Scenario& scenario, FlightWatcher* watcher = nullptr);

/// What one camera of the rig sees in a flight, drawn as `channel` whatever the rig asks for.
/// @param role   of the camera; InputError names the rig's roles when it has no such camera.
/// @param t_s    time of the image, >= 0; the flight is flown up to it, and for flow up to the camera's next image.
///               InputError when it ends before.
cv::Mat image_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s);

}  // namespace hedgehop::sim
