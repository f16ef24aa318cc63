#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::scenes::textures {

/// Images of plants, CV_8UC3, each a function of its arguments.
inline constexpr double kLeafTileM = 3.0;
inline constexpr double kBarkTileM = 1.5;

enum class Leaves { broad, needles, autumn };
/// Foliage as a closed surface: thousands of leaves in layers, the lower ones in shadow.
cv::Mat paint_leaves(Leaves leaves, int size_px, uint64_t seed);

/// Bark with furrows that run up the image.
cv::Mat paint_bark(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
