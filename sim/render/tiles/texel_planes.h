#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/tiles/huge_pages.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// The textures of a scene at every size down to one texel, in the layout of the kernels. A texel is the mean of the
/// pixels of the full image that it covers, rounded once. Greys and colors are each computed at the first use.
class TexelPlanes {
 public:
  /// @param textures  CV_8UC3 RGB, square, of one power-of-two size. An empty list gives one black texel.
  explicit TexelPlanes(const std::vector<cv::Mat>& textures);

  const TextureLayout& layout() const { return layout_; }

  const uint16_t* greys();  ///< means of the channels
  const uint32_t* colors();

 private:
  std::vector<cv::Mat> textures_;
  TextureLayout layout_{};
  HugeVector<uint16_t> greys_;
  HugeVector<uint32_t> colors_;
};

}  // namespace hedgehop::sim::tiles
