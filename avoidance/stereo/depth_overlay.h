#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace hedgehop::avoidance::stereo {

/// Returns depth in colors, from red (near) to blue (`far_m` and beyond, > 0), black if unknown, with a color bar.
/// @param depth_m  CV_32FC1, m; NaN if unknown. @return CV_8UC3, RGB.
cv::Mat depth_overlay(const cv::Mat& depth_m, double far_m);

/// Writes a line of text along the top edge of a CV_8UC3 image.
void caption(cv::Mat& image, const std::string& text);

}  // namespace hedgehop::avoidance::stereo
