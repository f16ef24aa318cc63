#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <stdexcept>
#include <string>

namespace hedgehop::scenes::mesh {

inline constexpr int kMaxImageSidePx = 8192;
inline constexpr size_t kMaxImageBytes = 300'000'000;

/// An image that has more than 8192 x 8192 pixels.
class ImageTooLarge : public std::invalid_argument {
 public:
  ImageTooLarge(int64_t width, int64_t height)
      : std::invalid_argument("it has " + std::to_string(width) + " x " + std::to_string(height) +
                              " px; valid: at most 8192 x 8192") {}
};

/// Throws ImageTooLarge if a side exceeds kMaxImageSidePx.
void require_size(int64_t width, int64_t height);

/// Returns the formats that decode_texture() reads, for messages.
std::string image_formats();

/// Returns a decoded BMP or TGA image (uncompressed or run-length encoded), as decode_texture() does.
cv::Mat decode_bmp(std::span<const uint8_t> bytes);
cv::Mat decode_tga(std::span<const uint8_t> bytes);
/// Returns a decoded TIFF or WebP image, as decode_texture() does; empty if the build lacks the library.
cv::Mat decode_tiff(std::span<const uint8_t> bytes);
cv::Mat decode_webp(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
