#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "scenes/mesh/texture_image.h"

namespace hedgehop::scenes::mesh {
namespace {

/// Reads little-endian numbers; 0 past the end.
class LittleEndian {
 public:
  explicit LittleEndian(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  uint32_t number(size_t offset, size_t size) const {
    uint32_t value = 0;
    for (size_t i = 0; i < size && offset + i < bytes_.size(); ++i) value |= uint32_t{bytes_[offset + i]} << 8 * i;
    return value;
  }

 private:
  std::span<const uint8_t> bytes_;
};

/// The part of a pixel's bits that holds a channel.
struct BitField {
  uint32_t mask = 0;

  uint8_t level(uint32_t pixel) const {
    if (mask == 0) return 255;
    const uint32_t top = mask >> std::countr_zero(mask);
    return static_cast<uint8_t>(uint64_t{(pixel & mask) >> std::countr_zero(mask)} * 255 / top);
  }
};

struct BmpHeader {
  int64_t width = 0, height = 0;
  bool is_top_down = false;
  uint32_t bits = 0, pixels_at = 0, palette_at = 0, palette_entry = 4;
  std::array<BitField, 4> fields;  ///< red, green, blue, alpha
};

BmpHeader header_of(const LittleEndian& file) {
  constexpr uint32_t kCoreHeader = 12, kFirstWithFields = 52, kFirstWithAlpha = 56, kBitFields = 3, kAlphaBitFields = 6;
  BmpHeader h;
  h.pixels_at = file.number(10, 4);
  const uint32_t header = file.number(14, 4);
  h.palette_at = 14 + header;
  if (header == kCoreHeader) {
    h.width = file.number(18, 2);
    h.height = file.number(20, 2);
    h.bits = file.number(24, 2);
    h.palette_entry = 3;
    return h;
  }
  h.width = static_cast<int32_t>(file.number(18, 4));
  const int64_t height = static_cast<int32_t>(file.number(22, 4));
  h.height = std::abs(height);
  h.is_top_down = height < 0;
  h.bits = file.number(28, 2);
  const uint32_t compression = file.number(30, 4);
  if (h.bits == 16) h.fields = {BitField{0x7c00}, BitField{0x3e0}, BitField{0x1f}, BitField{}};
  if (h.bits == 32) h.fields = {BitField{0xff0000}, BitField{0xff00}, BitField{0xff}, BitField{}};
  if (compression == kBitFields || compression == kAlphaBitFields) {
    const bool has_alpha = header >= kFirstWithAlpha || compression == kAlphaBitFields;
    for (size_t k = 0; k < (has_alpha ? 4 : 3); ++k) h.fields[k].mask = file.number(54 + 4 * k, 4);
    if (header < kFirstWithFields) h.palette_at += has_alpha ? 16 : 12;
  } else if (compression != 0) {
    h.bits = 0;  // run-length encoded
  }
  return h;
}

}  // namespace

cv::Mat decode_bmp(std::span<const uint8_t> bytes) {
  const LittleEndian file(bytes);
  const BmpHeader h = header_of(file);
  constexpr std::array<uint32_t, 6> kBits{1, 4, 8, 16, 24, 32};
  if (h.width <= 0 || h.height <= 0 || std::ranges::find(kBits, h.bits) == kBits.end()) return {};
  require_size(h.width, h.height);
  const auto width = static_cast<size_t>(h.width), height = static_cast<size_t>(h.height);
  const size_t row_bytes = (width * h.bits + 31) / 32 * 4;
  if (h.pixels_at > bytes.size() || row_bytes * height > bytes.size() - h.pixels_at) return {};
  const bool has_alpha = h.fields[3].mask != 0;
  const size_t channels = has_alpha ? 4 : 3;
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), has_alpha ? CV_8UC4 : CV_8UC3);
  for (size_t y = 0; y < height; ++y) {
    const size_t row = h.pixels_at + row_bytes * (h.is_top_down ? y : height - 1 - y);
    uint8_t* pixel = image.ptr(static_cast<int>(y));
    for (size_t x = 0; x < width; ++x, pixel += channels) {
      if (h.bits <= 8) {
        const size_t per_byte = 8 / h.bits, shift = 8 - h.bits * (x % per_byte + 1);
        const uint32_t index = bytes[row + x / per_byte] >> shift & ((1u << h.bits) - 1);
        for (size_t k = 0; k < 3; ++k) {
          pixel[k] = static_cast<uint8_t>(file.number(h.palette_at + h.palette_entry * index + 2 - k, 1));
        }
      } else if (h.bits == 24) {
        for (size_t k = 0; k < 3; ++k) pixel[k] = bytes[row + 3 * x + 2 - k];
      } else {
        const uint32_t value = file.number(row + h.bits / 8 * x, h.bits / 8);
        for (size_t k = 0; k < channels; ++k) pixel[k] = h.fields[k].level(value);
      }
    }
  }
  return image;
}

}  // namespace hedgehop::scenes::mesh
