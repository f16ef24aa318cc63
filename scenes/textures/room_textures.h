#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::scenes::textures {

// Textures of a room's surfaces, CV_8UC3, with sides of kRoomTileM. Each depends on its arguments only.
inline constexpr double kRoomTileM = 4.0;

enum class WallPaper { stripes, brick, damask, plaster };

/// Returns `variants` textures of one wall. They share the wallpaper and differ in the posters on it, so that they
/// match horizontally in any order. Row 0 is the top of a wall 4 m high; a lower wall shows the lower part.
std::vector<cv::Mat> paint_room_walls(WallPaper paper, int size_px, int variants, uint64_t seed);

cv::Mat paint_parquet(int size_px, uint64_t seed);
cv::Mat paint_carpet(int size_px, uint64_t seed);
cv::Mat paint_ceiling(int size_px, uint64_t seed);

/// Furniture: shelves with books, and wooden drawers. One texture provides detail for four pieces.
cv::Mat paint_shelves(int size_px, uint64_t seed);
cv::Mat paint_drawers(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
