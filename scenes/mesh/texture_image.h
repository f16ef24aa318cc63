#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

namespace hedgehop::scenes::mesh {

/// Returns the decoded texture of a mesh: PNG of any depth, JPEG, or PPM and PGM (P2, P3, P5, P6), without
/// transparency.
/// @return CV_8UC3, RGB; empty if the format is another, the data is invalid, or it has more than 64 million pixels.
cv::Mat decode_texture(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
