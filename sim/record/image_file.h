#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace hedgehop::sim {

/// Writes a PNG. @param image  CV_8UC1, CV_16UC1, or CV_8UC3 or CV_16UC3 in RGB. Throws std::runtime_error
/// with the file and the cause. The file is complete or absent.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

/// Returns the bytes of the PNG that write_png() writes. Throws std::invalid_argument for another type of image.
std::string png_of(const cv::Mat& image);

/// Writes an uncompressed TIFF of 32-bit floats. @param image  CV_32FC1. Throws as write_png().
void write_tiff(const std::filesystem::path& file, const cv::Mat& image);

/// Returns labels or classes as CV_16UC1. @param labels  CV_32SC1. Throws std::runtime_error for values over 65,535.
cv::Mat labels_16bit(const cv::Mat& labels);

/// Returns depth in mm, CV_16UC1; 0 for more than 65.5 m, the sky, and unknown depth. @param depth_m  CV_32FC1.
cv::Mat depth_mm(const cv::Mat& depth_m);

/// Returns the bytes of a JPEG file. @param rgb  CV_8UC3, RGB. @param quality  1..100.
std::string jpeg_of(const cv::Mat& rgb, int quality);

}  // namespace hedgehop::sim
