#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::scenes::textures {

/// Images of a room's surfaces, CV_8UC3, kRoomTileM a side, each a function of its arguments.
inline constexpr double kRoomTileM = 4.0;

enum class WallPaper { stripes, brick, damask, plaster };

/// Returns `variants` images of one wall: they share the paper and differ in the framed posters on it, so that they
/// continue each other sideways in any order. Row 0 is the top of a wall 4 m high; a lower wall shows the lower part.
std::vector<cv::Mat> paint_room_walls(WallPaper paper, int size_px, int variants, uint64_t seed);

cv::Mat paint_parquet(int size_px, uint64_t seed);
cv::Mat paint_carpet(int size_px, uint64_t seed);
cv::Mat paint_ceiling(int size_px, uint64_t seed);

/// Furniture, four pieces' worth of detail per image: shelves full of books, and drawers of wood.
cv::Mat paint_shelves(int size_px, uint64_t seed);
cv::Mat paint_drawers(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
