#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace hedgehop::avoidance::stereo {

/// Depth in colors, red near to blue at `far_m` (> 0) and beyond, black where unknown; with a bar of
/// the colors.
/// @param depth_m  CV_32FC1, m; NaN unknown. @return CV_8UC3, RGB.
cv::Mat depth_overlay(const cv::Mat& depth_m, double far_m);

/// Writes a line of text along the top edge of a CV_8UC3 image.
void caption(cv::Mat& image, const std::string& text);

}  // namespace hedgehop::avoidance::stereo
