#include "avoidance/stereo/depth_overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace hedgehop::avoidance::stereo {
namespace {

/// White letters with a black edge.
void write(cv::Mat& image, const std::string& text, cv::Point where, double scale) {
  cv::putText(image, text, where, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(0), 3, cv::LINE_AA);
  cv::putText(image, text, where, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(255), 1, cv::LINE_AA);
}

/// Draws the color bar near the lower right corner, 0 m at the bottom.
void draw_bar(cv::Mat& image, double far_m) {
  constexpr int kMinWidthPx = 64, kMinHeightPx = 48;  // a smaller image would be hidden by the bar
  if (image.cols < kMinWidthPx || image.rows < kMinHeightPx) return;
  const int width = std::max(4, image.cols / 80), height = image.rows / 2, edge = 2 * width;
  cv::Mat levels(height, width, CV_8UC1), colors;
  for (int row = 0; row < height; ++row) levels.row(row) = cv::Scalar::all(255.0 * row / std::max(1, height - 1));
  cv::applyColorMap(levels, colors, cv::COLORMAP_TURBO);
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  const cv::Rect place(image.cols - edge - width, image.rows - edge - height, width, height);
  colors.copyTo(image(place));
  cv::rectangle(image, place, cv::Scalar::all(255));
  const double scale = std::max(0.3, image.cols / 1600.0);
  const auto label = [&](const std::string& text, int y) {
    const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, nullptr);
    write(image, text, {place.x - size.width - width / 2, y + size.height / 2}, scale);
  };
  label(std::to_string(std::lround(far_m)) + " m", place.y);
  label("0 m", place.y + height);
}

}  // namespace

cv::Mat depth_overlay(const cv::Mat& depth_m, double far_m) {
  constexpr double kUnknown = -1.0;
  cv::Mat depth = depth_m.clone(), closeness(depth_m.size(), CV_8UC1), colors;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double share = std::min(1.0, depth_m.at<float>(v, u) / far_m);  // 1 for NaN
      closeness.at<uint8_t>(v, u) = static_cast<uint8_t>(255.0 * (1.0 - share));
    }
  }
  cv::applyColorMap(closeness, colors, cv::COLORMAP_TURBO);
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  cv::patchNaNs(depth, kUnknown);
  colors.setTo(cv::Scalar::all(0), depth == kUnknown);
  draw_bar(colors, far_m);
  return colors;
}

void caption(cv::Mat& image, const std::string& text) {
  const double scale = std::max(0.4, image.cols / 1200.0);
  write(image, text, {6, static_cast<int>(24 * scale) + 4}, scale);
}

}  // namespace hedgehop::avoidance::stereo
