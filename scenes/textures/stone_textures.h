#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::scenes::textures {

// Textures of stone, walls and roads, CV_8UC3. Each depends on its arguments only.
inline constexpr double kRockTileM = 2.0;
inline constexpr double kAsphaltTileM = 8.0;
inline constexpr double kWallTileM = 4.0;

cv::Mat paint_rock(int size_px, uint64_t seed);
cv::Mat paint_asphalt_road(int size_px, uint64_t seed);  ///< without lines
cv::Mat paint_brick_wall(int size_px, uint64_t seed);

/// Returns smooth variations of brightness over meters: gradients almost everywhere, but no corners.
cv::Mat paint_clouded_wall(int size_px, uint64_t seed);

/// Returns a uniform texture.
cv::Mat paint_blank(int size_px, const cv::Vec3f& color);

/// Returns an image with its contrast about the mean color multiplied by `strength`, 0..1.
cv::Mat faded(const cv::Mat& image, double strength);

}  // namespace hedgehop::scenes::textures
