#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::scenes::textures {

/// Images of the city's ground and roofs, CV_8UC3. Each is a function of its arguments.
inline constexpr double kStreetTileM = 8.0;  ///< also the width that a street's image is painted for
inline constexpr double kLotTileM = 8.0;
inline constexpr double kGrassTileM = 16.0;
inline constexpr double kRoofTileM = 12.0;

/// A street that runs up the image: pavement, kerb, lane, dashed line, lane, kerb, pavement.
cv::Mat paint_street(int size_px, uint64_t seed);

/// Where two streets cross: zebra crossings on all sides, pavement in the corners.
cv::Mat paint_crossing(int size_px, uint64_t seed);

cv::Mat paint_paved_lot(int size_px, uint64_t seed);
cv::Mat paint_parking_lot(int size_px, uint64_t seed);
cv::Mat paint_garden_lot(int size_px, uint64_t seed);
cv::Mat paint_grass(int size_px, uint64_t seed);
cv::Mat paint_field(int size_px, uint64_t seed);  ///< rows of ripe crop, kGrassTileM a side

enum class RoofCover { felt, gravel };
cv::Mat paint_roof(RoofCover cover, int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
