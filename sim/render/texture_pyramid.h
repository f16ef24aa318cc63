#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::sim {

/// Returns a picture at every size down to 1 x 1, CV_8UC4: R, G, B and 255. Each pixel is the mean of the full
/// picture's pixels that it covers, rounded once.
/// @param picture  CV_8UC3 RGB, square, a power of two wide.
std::vector<cv::Mat> texture_pyramid(const cv::Mat& picture);

}  // namespace hedgehop::sim
