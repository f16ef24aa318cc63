#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

namespace hedgehop::scenes::mesh {

/// Decodes the texture of a mesh: PNG of any depth, or JPEG. Transparency is dropped.
/// @return CV_8UC3, RGB; empty for what is neither, is broken, or has more than 64 million pixels.
cv::Mat decode_texture(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
