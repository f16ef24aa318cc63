#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::sim {

/// One picture at every size down to 1 x 1, each pixel the mean of the full picture's pixels it covers, rounded once.
struct TexturePyramid {
  std::vector<cv::Mat> color;  ///< CV_8UC4, RGB and 255
  std::vector<cv::Mat> grey;   ///< CV_8UC1, mean of R, G and B
};

/// @param picture  CV_8UC3 RGB, square, a power of two wide.
TexturePyramid texture_pyramid(const cv::Mat& picture);

}  // namespace hedgehop::sim
