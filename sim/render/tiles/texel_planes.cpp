#include "sim/render/tiles/texel_planes.h"

#include <bit>

namespace hedgehop::sim::tiles {

namespace {

scenes::TextureList black_texel() { return std::vector<cv::Mat>{cv::Mat::zeros(1, 1, CV_8UC3)}; }

/// Sums of pixels over the squares that the texels of a level cover. They are exact and thus equal on every processor.
using SumsOfLevel = std::vector<uint32_t>;

/// @param of_pixel  returns the value of a pixel to sum.
template <class OfPixel>
SumsOfLevel sums_of(const cv::Mat& texture, const OfPixel& of_pixel) {
  SumsOfLevel sums;
  sums.reserve(texture.total());
  for (int row = 0; row < texture.rows; ++row) {
    for (int col = 0; col < texture.cols; ++col) sums.push_back(of_pixel(texture.at<cv::Vec3b>(row, col)));
  }
  return sums;
}

SumsOfLevel halved(const SumsOfLevel& sums, size_t size) {
  SumsOfLevel smaller;
  smaller.reserve(sums.size() / 4);
  for (size_t row = 0; row < size; row += 2) {
    for (size_t col = 0; col < size; col += 2) {
      const uint32_t* const upper = &sums[row * size + col];
      smaller.push_back(upper[0] + upper[1] + upper[size] + upper[size + 1]);
    }
  }
  return smaller;
}

/// Calls `add` with each level of a texture: level, size, values minus 128 in row-major order.
/// @param channels  number of channels in the sum of a pixel, 1 or 3.
template <class Add>
void each_level(SumsOfLevel sums, const TextureLayout& layout, uint64_t channels, const Add& add) {
  std::vector<uint8_t> levels;
  auto size = static_cast<size_t>(layout.size_px);
  for (int level = 0; level <= layout.last_level; ++level, size /= 2) {
    if (level > 0) sums = halved(sums, 2 * size);
    const uint64_t half = channels << 2 * level;  // sum / (channels 4^level), rounded
    levels.clear();
    for (const uint64_t sum : sums) {
      const uint64_t scaled = (2 * sum + half) >> (2 * level + 1);
      levels.push_back(static_cast<uint8_t>((channels == 3 ? scaled / 3 : scaled) ^ 0x80));
    }
    add(level, size, levels);
  }
}

}  // namespace

TexelPlanes::TexelPlanes(const scenes::TextureList& textures) : textures_(textures.empty() ? black_texel() : textures) {
  layout_.size_px = textures_.size_px();
  layout_.size_log2 = std::countr_zero(static_cast<uint32_t>(layout_.size_px));
  layout_.last_level = layout_.size_log2;
  for (int level = 0; level <= layout_.last_level; ++level) {
    const auto size = static_cast<size_t>(layout_.size_px >> level);
    layout_.first[level] = static_cast<int32_t>(layout_.positions);
    layout_.positions += size * (size + 1);
  }
}

const uint16_t* TexelPlanes::greys() {
  if (!greys_.empty()) return greys_.data();
  greys_.reserve(textures_.size() * layout_.positions);
  const auto grey = [](const cv::Vec3b& rgb) { return uint32_t{rgb[0]} + rgb[1] + rgb[2]; };
  const auto add = [&](int, size_t size, const std::vector<uint8_t>& levels) {
    for (size_t row = 0; row < size; ++row) {
      const uint8_t* const here = &levels[row * size];
      const uint8_t* const below = &levels[(row + 1) % size * size];
      for (size_t col = 0; col < size; ++col) greys_.push_back(static_cast<uint16_t>(here[col] | below[col] << 8));
      greys_.push_back(static_cast<uint16_t>(here[0] | below[0] << 8));
    }
  };
  for (const cv::Mat& texture : textures_.images()) each_level(sums_of(texture, grey), layout_, 3, add);
  return greys_.data();
}

const uint32_t* TexelPlanes::colors() {
  if (!colors_.empty()) return colors_.data();
  colors_.resize(textures_.size() * layout_.positions);
  const std::vector<cv::Mat> images = textures_.images();
  for (size_t texture = 0; texture < images.size(); ++texture) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto value = [channel](const cv::Vec3b& rgb) { return uint32_t{rgb[channel]}; };
      const auto add = [&](int level, size_t size, const std::vector<uint8_t>& levels) {
        uint32_t* place = &colors_[texture * layout_.positions + static_cast<size_t>(layout_.first[level])];
        for (size_t row = 0; row < size; ++row) {
          for (size_t col = 0; col <= size; ++col) *place++ |= uint32_t{levels[row * size + col % size]} << 8 * channel;
        }
      };
      each_level(sums_of(images[texture], value), layout_, 1, add);
    }
  }
  return colors_.data();
}

}  // namespace hedgehop::sim::tiles
