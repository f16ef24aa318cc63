#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace hedgehop::sim {

/// Writes a PNG. @param image  CV_8UC1, CV_16UC1, or CV_8UC3 in RGB. Throws std::runtime_error naming the file.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace hedgehop::sim
