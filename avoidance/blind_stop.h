#pragma once

#include <cstdint>
#include <memory>

#include "avoidance/module.h"

namespace hedgehop::avoidance {

/// Returns the time without a good image of a required camera after which a module counts as blind, ns: half a second,
/// or three periods of a slow camera. @param rate_hz  image rate of the camera, > 0.
int64_t blind_after_ns(double rate_hz);

/// Returns the module with a blindness monitor around it. If a required camera has delivered no good image for longer
/// than blind_after_ns(), the decision is a HoverCommand with the status "blind", and the module is not called.
/// A good image is present, not black (at least one pixel differs from 0) and not frozen. A frozen image equals its
/// predecessor bit for bit and is not uniform; a blank wall gives uniform images. Depth and corners simulate ideal
/// sensors, so only a missing frame is bad. A module that needs no camera is returned unchanged.
std::unique_ptr<Module> stopping_when_blind(std::unique_ptr<Module> module);

}  // namespace hedgehop::avoidance
