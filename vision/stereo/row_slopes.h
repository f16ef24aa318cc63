#pragma once

#include <cstdint>

namespace hedgehop::vision::stereo {

/// Slopes are limited to +-kMaxSlope and stored as slope + kMaxSlope.
inline constexpr int kMaxSlope = 31;

/// Computes the slopes of brightness along a row, except at its ends: differences over two pixels, weighted 1 2 1 over
/// three rows. @param slopes  `width` values.
void row_slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width, uint8_t* slopes);

}  // namespace hedgehop::vision::stereo
