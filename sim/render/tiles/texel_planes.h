#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/tiles/huge_pages.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// A scene's textures at every size down to one texel, as kernels read them. A texel is the mean of the full image's
/// pixels that it covers, rounded once. Greys and colors are made when they are asked for first.
class TexelPlanes {
 public:
  /// @param textures  CV_8UC3 RGB, square, all of one power-of-two size; none make one black texel.
  explicit TexelPlanes(const std::vector<cv::Mat>& textures);

  const TextureLayout& layout() const { return layout_; }

  const uint16_t* greys();  ///< the mean of the channels
  const uint32_t* colors();

 private:
  std::vector<cv::Mat> textures_;
  TextureLayout layout_{};
  HugeVector<uint16_t> greys_;
  HugeVector<uint32_t> colors_;
};

}  // namespace hedgehop::sim::tiles
