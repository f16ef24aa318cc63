#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::stereo {

/// A disparity image (vision/stereo/disparity.h) and coarser ones above it: each pixel of level n + 1 holds the
/// largest, that is nearest, disparity of a 2 x 2 block of level n; edges are padded with unknown. Level 0 is the image
/// itself, padded to multiples of 2^top. Keeps its memory from image to image. Source: [Andert2007] sec. 4.2.
class DepthPyramid {
 public:
  /// @param disparity16  CV_16SC1. @param top  the coarsest level, in [0, 15]. Throws std::invalid_argument otherwise.
  void build(const cv::Mat& disparity16, int top);

  int top() const { return static_cast<int>(levels_.size()) - 1; }
  const cv::Mat& level(int n) const { return levels_[static_cast<size_t>(n)]; }
  int disparity16(int n, int row, int col) const { return level(n).at<int16_t>(row, col); }
  /// Of the image it was built from.
  cv::Size image() const { return image_; }

 private:
  cv::Size image_;
  std::vector<cv::Mat> levels_;
};

}  // namespace hedgehop::vision::stereo
