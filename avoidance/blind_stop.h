#pragma once

#include <cstdint>
#include <memory>

#include "avoidance/module.h"

namespace hedgehop::avoidance {

/// How long a module may go without a good image of a camera it needs before it counts as blind, ns: half a second, or
/// three images of a slow camera. @param rate_hz  of the camera, > 0.
int64_t blind_after_ns(double rate_hz);

/// Returns the module, made to stop where it cannot see: while a camera that it needs has delivered no good image for
/// longer than blind_after_ns(), the decision is a HoverCommand of status "blind", and the module is not asked. An
/// image is good unless it is missing, black (every pixel 0), or frozen (bit for bit the last one, and not of one value
/// all over, as a blank wall's is). Of depth and corners, which stand for ideal sensors, only missing ones count. In
/// all else the module's own, and the module itself where it needs no camera.
std::unique_ptr<Module> stopping_when_blind(std::unique_ptr<Module> module);

}  // namespace hedgehop::avoidance
