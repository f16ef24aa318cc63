#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::scenes::textures {

/// An image of strips for the foot and the top of buildings, CV_8UC3, tileable sideways: from the top, kShopStrips
/// strips of shop fronts, each kShopM high, then a cornice of kCorniceM.
inline constexpr double kTrimTileM = 12.0;
inline constexpr int kShopStrips = 3;
inline constexpr double kShopM = 3.75;
inline constexpr double kCorniceM = 0.75;
inline constexpr int kShopBays = 3;  ///< across the image
cv::Mat paint_trim(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
