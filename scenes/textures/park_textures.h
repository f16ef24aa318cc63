#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "scenes/textures/canvas.h"

namespace hedgehop::scenes::textures {

// Textures of plants and parked vehicles, CV_8UC3. Each depends on its arguments only.
inline constexpr double kLeafTileM = 3.0;
inline constexpr double kBarkTileM = 1.5;

enum class Leaves { broad, needles, autumn };
/// Returns foliage as a closed surface: thousands of leaves in layers, with the lower layers in shadow.
cv::Mat paint_leaves(Leaves leaves, int size_px, uint64_t seed);

/// Returns bark with furrows that run up the image.
cv::Mat paint_bark(int size_px, uint64_t seed);

/// Side of the vehicles' textures. Their lower edge is at multiples of this height above the ground.
inline constexpr double kVehicleTileM = 5.0;

/// Returns the lower body: paint, doors, bumpers, and wheels with their shadow.
cv::Mat paint_vehicle_body(const Color& paint, int size_px, uint64_t seed);

/// Returns the cabin: panes and pillars from 0.9 m to 2 m above the ground, and paint elsewhere.
cv::Mat paint_vehicle_cabin(const Color& paint, int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
