#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::scenes::textures {

// Textures of the city's ground and roofs, CV_8UC3. Each depends on its arguments only.
inline constexpr double kStreetTileM = 8.0;  ///< also the nominal width of a street
inline constexpr double kLotTileM = 8.0;
inline constexpr double kGrassTileM = 16.0;
inline constexpr double kRoofTileM = 12.0;

/// Returns a street that runs up the image: sidewalk, curb, lane, dashed line, lane, curb, sidewalk.
cv::Mat paint_street(int size_px, uint64_t seed);

/// Returns the crossing of two streets: crosswalks on all sides, sidewalk in the corners.
cv::Mat paint_crossing(int size_px, uint64_t seed);

/// Returns patches of asphalt of any age, with joints, cracks, stains and covers, with sides of kGrassTileM.
cv::Mat paint_repairs(int size_px, uint64_t seed);

cv::Mat paint_paved_lot(int size_px, uint64_t seed);
cv::Mat paint_parking_lot(int size_px, uint64_t seed);
cv::Mat paint_garden_lot(int size_px, uint64_t seed);
cv::Mat paint_grass(int size_px, uint64_t seed);
cv::Mat paint_field(int size_px, uint64_t seed);  ///< rows of ripe crop, with sides of kGrassTileM

enum class RoofCover { felt, gravel };
cv::Mat paint_roof(RoofCover cover, int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
