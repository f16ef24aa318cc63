#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "scenes/mesh/texture_image.h"

namespace hedgehop::scenes::mesh {
namespace {

constexpr size_t kTgaHeader = 18;

using Rgba = std::array<uint8_t, 4>;

/// Returns a pixel of 8, 15, 16, 24 or 32 bits, blue first.
Rgba pixel_of(std::span<const uint8_t> bytes) {
  if (bytes.size() == 1) return {bytes[0], bytes[0], bytes[0], 255};
  if (bytes.size() == 2) {
    const unsigned value = bytes[0] | bytes[1] << 8;
    const auto level = [&](unsigned shift) { return static_cast<uint8_t>((value >> shift & 31u) * 255 / 31); };
    return {level(10), level(5), level(0), 255};
  }
  return {bytes[2], bytes[1], bytes[0], bytes.size() == 4 ? bytes[3] : uint8_t{255}};
}

struct TgaHeader {
  bool has_palette = false, is_run_length = false, is_from_right = false, is_from_top = false;
  size_t palette_first = 0, palette_size = 0, palette_entry = 0;  ///< bytes per entry
  size_t width = 0, height = 0, pixel = 0;                        ///< bytes per pixel
  size_t palette_at = 0;
};

/// Returns the header; width 0 if the data is not a TGA image.
TgaHeader header_of(std::span<const uint8_t> bytes) {
  constexpr uint8_t kRunLength = 8, kPalette = 1, kColor = 2, kGrey = 3;
  if (bytes.size() < kTgaHeader) return {};
  const auto word = [&](size_t at) { return size_t{bytes[at]} | size_t{bytes[at + 1]} << 8; };
  const int kind = bytes[2] & ~kRunLength;
  TgaHeader h{.has_palette = kind == kPalette,
              .is_run_length = (bytes[2] & kRunLength) != 0,
              .is_from_right = (bytes[17] & 0x10) != 0,
              .is_from_top = (bytes[17] & 0x20) != 0,
              .palette_first = word(3),
              .palette_size = bytes[1] == 1 ? word(5) : 0,
              .palette_entry = (size_t{bytes[7]} + 7) / 8,
              .width = word(12),
              .height = word(14),
              .pixel = (size_t{bytes[16]} + 7) / 8,
              .palette_at = kTgaHeader + bytes[0]};
  const bool depth_fits = kind == kColor ? h.pixel >= 2 && h.pixel <= 4 : h.pixel == 1;
  const bool palette_fits = !h.has_palette || (bytes[1] == 1 && h.palette_entry >= 2 && h.palette_entry <= 4);
  if (kind < kPalette || kind > kGrey || bytes[1] > 1 || !depth_fits || !palette_fits || h.height == 0) h.width = 0;
  return h;
}

/// Returns the pixels without run lengths; empty if the data ends too early.
std::vector<uint8_t> expanded(std::span<const uint8_t> data, size_t pixel, size_t count) {
  std::vector<uint8_t> result;
  result.reserve(count * pixel);
  while (result.size() < count * pixel) {
    if (data.empty()) return {};
    const bool repeats = (data[0] & 0x80) != 0;
    const size_t run = (data[0] & 0x7fu) + 1u, stored = (repeats ? 1 : run) * pixel;
    if (data.size() < 1 + stored) return {};
    for (size_t i = 0; i < (repeats ? run : 1); ++i) {
      result.insert(result.end(), data.begin() + 1, data.begin() + 1 + static_cast<std::ptrdiff_t>(stored));
    }
    data = data.subspan(1 + stored);
  }
  return result;
}

}  // namespace

cv::Mat decode_tga(std::span<const uint8_t> bytes) {
  const TgaHeader h = header_of(bytes);
  if (h.width == 0) return {};
  require_size(static_cast<int64_t>(h.width), static_cast<int64_t>(h.height));
  const size_t data_at = h.palette_at + h.palette_size * h.palette_entry, count = h.width * h.height;
  if (data_at > bytes.size()) return {};
  std::span<const uint8_t> data = bytes.subspan(data_at);
  std::vector<uint8_t> runs;
  if (h.is_run_length) data = runs = expanded(data, h.pixel, count);
  if (data.size() < count * h.pixel) return {};
  const bool has_alpha = (h.has_palette ? h.palette_entry : h.pixel) == 4;
  const size_t channels = has_alpha ? 4 : 3;
  cv::Mat image(static_cast<int>(h.height), static_cast<int>(h.width), has_alpha ? CV_8UC4 : CV_8UC3);
  for (size_t i = 0; i < count; ++i) {
    std::span<const uint8_t> stored = data.subspan(i * h.pixel, h.pixel);
    if (h.has_palette) {
      const size_t entry = size_t{stored[0]} - h.palette_first;
      if (stored[0] < h.palette_first || entry >= h.palette_size) return {};
      stored = bytes.subspan(h.palette_at + entry * h.palette_entry, h.palette_entry);
    }
    const Rgba pixel = pixel_of(stored);
    const size_t x = h.is_from_right ? h.width - 1 - i % h.width : i % h.width;
    const size_t y = h.is_from_top ? i / h.width : h.height - 1 - i / h.width;
    std::copy_n(pixel.begin(), channels, image.ptr(static_cast<int>(y)) + x * channels);
  }
  return image;
}

}  // namespace hedgehop::scenes::mesh
