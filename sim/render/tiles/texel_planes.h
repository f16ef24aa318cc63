#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/tiles/huge_pages.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// A scene's textures at every size down to one texel, as kernels read them. A texel is the mean of the full image's
/// pixels that it covers, rounded once. Each plane is made when it is asked for first.
class TexelPlanes {
 public:
  /// @param textures  CV_8UC3 RGB, square, all of one power-of-two size; none make one black texel.
  explicit TexelPlanes(const std::vector<cv::Mat>& textures);

  const TextureLayout& layout() const { return layout_; }

  enum class Of { red, green, blue, grey };  ///< grey: the mean of the channels
  TexelPlane plane(Of of);

 private:
  void add_texture(const cv::Mat& texture, Of of, HugeVector<uint16_t>& places) const;

  std::vector<cv::Mat> textures_;
  TextureLayout layout_{};
  std::array<HugeVector<uint16_t>, 4> planes_;
};

}  // namespace hedgehop::sim::tiles
