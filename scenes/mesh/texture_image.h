#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

namespace hedgehop::scenes::mesh {

/// Decodes the texture of a mesh: PNG of any depth, JPEG, or PPM and PGM (P2, P3, P5, P6). Transparency is dropped.
/// @return CV_8UC3, RGB; empty for what is none of these, is broken, or has more than 64 million pixels.
cv::Mat decode_texture(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
