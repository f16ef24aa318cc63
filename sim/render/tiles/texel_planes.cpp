#include "sim/render/tiles/texel_planes.h"

#include <bit>

namespace hedgehop::sim::tiles {

namespace {

/// Sums of an image's pixels over the squares that a level's texels cover: exact, and so the same everywhere.
using SumsOfLevel = std::vector<uint64_t>;

SumsOfLevel sums_of(const cv::Mat& texture, TexelPlanes::Of of) {
  SumsOfLevel sums;
  sums.reserve(texture.total());
  for (int row = 0; row < texture.rows; ++row) {
    for (int col = 0; col < texture.cols; ++col) {
      const auto& rgb = texture.at<cv::Vec3b>(row, col);
      const bool grey = of == TexelPlanes::Of::grey;
      sums.push_back(grey ? uint64_t{rgb[0]} + rgb[1] + rgb[2] : uint64_t{rgb[static_cast<int>(of)]});
    }
  }
  return sums;
}

SumsOfLevel halved(const SumsOfLevel& sums, size_t size) {
  SumsOfLevel smaller;
  smaller.reserve(sums.size() / 4);
  for (size_t row = 0; row < size; row += 2) {
    for (size_t col = 0; col < size; col += 2) {
      const uint64_t* const upper = &sums[row * size + col];
      smaller.push_back(upper[0] + upper[1] + upper[size] + upper[size + 1]);
    }
  }
  return smaller;
}

}  // namespace

TexelPlanes::TexelPlanes(const std::vector<cv::Mat>& textures) : textures_(textures) {
  if (textures_.empty()) textures_.emplace_back(cv::Mat::zeros(1, 1, CV_8UC3));
  layout_.size_px = textures_.front().cols;
  layout_.size_log2 = std::countr_zero(static_cast<uint32_t>(layout_.size_px));
  layout_.last_level = layout_.size_log2;
  size_t places = 0;
  for (int level = 0; level <= layout_.last_level; ++level) {
    const auto size = static_cast<size_t>(layout_.size_px >> level);
    layout_.first[level] = static_cast<int32_t>(places);
    places += size * (size + 1);
  }
  layout_.places = places;
}

TexelPlane TexelPlanes::plane(Of of) {
  HugeVector<uint16_t>& places = planes_[static_cast<size_t>(of)];
  if (places.empty()) {
    places.reserve(textures_.size() * layout_.places);
    for (const cv::Mat& texture : textures_) add_texture(texture, of, places);
  }
  return {places.data()};
}

void TexelPlanes::add_texture(const cv::Mat& texture, Of of, HugeVector<uint16_t>& places) const {
  SumsOfLevel sums = sums_of(texture, of);
  std::vector<uint8_t> levels;
  auto size = static_cast<size_t>(layout_.size_px);
  for (int level = 0; level <= layout_.last_level; ++level, size /= 2) {
    if (level > 0) sums = halved(sums, 2 * size);
    // sum / (channels 4^level), rounded.
    const uint64_t channels = of == Of::grey ? 3 : 1, half = channels << 2 * level;
    levels.clear();
    for (const uint64_t sum : sums) {
      const uint64_t scaled = (2 * sum + half) >> (2 * level + 1);
      levels.push_back(static_cast<uint8_t>((channels == 3 ? scaled / 3 : scaled) ^ 0x80));  // as a signed byte: less 128
    }
    for (size_t row = 0; row < size; ++row) {
      const uint8_t* const here = &levels[row * size];
      const uint8_t* const below = &levels[(row + 1) % size * size];
      for (size_t col = 0; col < size; ++col) places.push_back(static_cast<uint16_t>(here[col] | below[col] << 8));
      places.push_back(static_cast<uint16_t>(here[0] | below[0] << 8));
    }
  }
}

}  // namespace hedgehop::sim::tiles
