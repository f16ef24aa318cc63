#pragma once

#include <string>
#include <vector>

#include "avoidance/module.h"
#include "dynamics/avionics.h"

namespace hedgehop::sim {

/// Lists what is true of all that a module gets: "camera 'left': depth", "camera 'front': projected corners",
/// "sensor 'gps': exact", "sensor 'imu': exact gyros". An instrument is exact when none of its readings errs: all
/// noise, offsets, wander and misalignment are 0; that it is late, slow or sometimes silent makes it no less true.
/// Images without noise and lenses known exactly are no truth about the world.
/// @param needs  of the module. @param avionics  whose sensors feed its navigation.
std::vector<std::string> truth_used(const avoidance::Needs& needs, const dynamics::AvionicsConfig& avionics);

}  // namespace hedgehop::sim
