#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "scenes/textures/canvas.h"

namespace hedgehop::scenes::textures {

/// Images of parked vehicles, CV_8UC3, each a function of its arguments. Their foot lies on the ground: the lower end
/// of an image is at multiples of kVehicleTileM above it.
inline constexpr double kVehicleTileM = 5.0;

/// The lower body: paint, doors, bumpers, and wheels in their shadow.
cv::Mat paint_vehicle_body(const Color& paint, int size_px, uint64_t seed);

/// The cabin: panes and pillars from 0.9 m to 2 m above the ground, else paint.
cv::Mat paint_vehicle_cabin(const Color& paint, int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
