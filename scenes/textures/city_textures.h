#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "scenes/texture_list.h"

namespace hedgehop::scenes::textures {

// The trim texture covers the bottom and the top of buildings. It consists of strips, tileable horizontally: from the
// top, kShopStrips strips of shop fronts, each kShopM high, then a cornice of height kCorniceM.
inline constexpr double kTrimTileM = 12.0;
inline constexpr int kShopStrips = 3;
inline constexpr double kShopM = 3.75;
inline constexpr double kCorniceM = 0.75;
inline constexpr int kShopBays = 3;  ///< across the image
/// Returns the trim texture, CV_8UC3.
cv::Mat paint_trim(int size_px, uint64_t seed);

/// All textures of a city, and their indices in the list.
struct CityTextures {
  static constexpr int kFacadeVariants = 2;

  TextureList images;
  std::array<uint32_t, 2> streets{};
  uint32_t crossing = 0;
  std::array<uint32_t, 3> lots{};
  uint32_t grass = 0;
  uint32_t field = 0;
  std::array<uint32_t, 2> roofs{};
  std::array<uint32_t, 2> trims{};
  uint32_t repairs = 0;       ///< of streets; only in a city with wear
  uint32_t first_facade = 0;  ///< kFacadeVariants per facade style

  uint32_t facade(int style, int variant) const {
    return first_facade + static_cast<uint32_t>(style * kFacadeVariants + variant);
  }
};

/// Returns the textures of a city. @param wear  with those of repairs.
CityTextures city_textures(int size_px, uint64_t seed, bool wear);

}  // namespace hedgehop::scenes::textures
