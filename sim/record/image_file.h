#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace hedgehop::sim {

/// Writes a PNG. @param image  CV_8UC1, CV_16UC1, or CV_8UC3 or CV_16UC3 in RGB. Throws std::runtime_error naming the
/// file and the cause; a file that is there is whole.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

/// Depth in m as CV_16UC1 of mm; 0 where it is farther than that holds, sky, or unknown. @param depth_m  CV_32FC1.
cv::Mat depth_mm(const cv::Mat& depth_m);

/// @param rgb  CV_8UC3, RGB. @param quality  1..100. @return the bytes of a JPEG file.
std::string jpeg_of(const cv::Mat& rgb, int quality);

}  // namespace hedgehop::sim
