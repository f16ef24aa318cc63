#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::scenes::textures {

/// All images of a city and where each stands in the list.
struct CityTextures {
  static constexpr int kFacadeVariants = 2;

  std::vector<cv::Mat> images;
  std::array<uint32_t, 2> streets{};
  uint32_t crossing = 0;
  std::array<uint32_t, 3> lots{};
  uint32_t grass = 0;
  uint32_t field = 0;
  std::array<uint32_t, 2> roofs{};
  std::array<uint32_t, 2> trims{};
  uint32_t first_facade = 0;  ///< kFacadeVariants of each facade style

  uint32_t facade(int style, int variant) const {
    return first_facade + static_cast<uint32_t>(style * kFacadeVariants + variant);
  }
};

CityTextures paint_city(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::textures
