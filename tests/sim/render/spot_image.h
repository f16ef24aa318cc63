#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

/// Returns an image that is white at the center and fades to black before the sides; CV_8UC3.
inline cv::Mat spot_image(int size_px) {
  cv::Mat image(size_px, size_px, CV_8UC3);
  for (int row = 0; row < size_px; ++row) {
    for (int col = 0; col < size_px; ++col) {
      const double center_px = 0.5 * (size_px - 1), radius_px = 31.0 / 64.0 * size_px;
      const double r = std::hypot(col - center_px, row - center_px) / radius_px;
      const double level = r < 1.0 ? 127.5 * (1.0 + std::cos(std::numbers::pi * r)) : 0.0;
      image.at<cv::Vec3b>(row, col) = cv::Vec3b::all(cv::saturate_cast<uint8_t>(level));
    }
  }
  return image;
}

/// Returns the center of brightness of an image, (u, v), px.
inline Eigen::Vector2d centroid(const cv::Mat& grey) {
  const cv::Moments moments = cv::moments(grey);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

}  // namespace hedgehop::sim
