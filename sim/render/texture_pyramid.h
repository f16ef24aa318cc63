#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::sim {

/// Returns an image at every size down to 1 x 1, CV_8UC4: R, G, B and 255. Each pixel is the mean of the full
/// image's pixels that it covers, rounded once.
/// @param image  CV_8UC3 RGB, square, a power of two wide.
std::vector<cv::Mat> texture_pyramid(const cv::Mat& image);

}  // namespace hedgehop::sim
