#include "sim/render/image_colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

namespace {

constexpr double kHues = 180.0;  // full circle in OpenCV

cv::Mat from_hsv(const cv::Mat& hsv) {
  cv::Mat rgb;
  cv::cvtColor(hsv, rgb, cv::COLOR_HSV2RGB);
  return rgb;
}

}  // namespace

cv::Mat colored_depth(const cv::Mat& depth_m) {
  cv::Mat levels(depth_m.size(), CV_8UC1), rgb;
  const double span = std::log(kMaxColorM / kMinColorM);
  constexpr double kBlue = 25.0, kRed = 255.0;  // below 25, the map is nearly black
  for (int row = 0; row < depth_m.rows; ++row) {
    for (int col = 0; col < depth_m.cols; ++col) {
      const double color_share = std::log(kMaxColorM / static_cast<double>(depth_m.at<float>(row, col))) / span;
      levels.at<uint8_t>(row, col) =
          std::isnan(color_share)
              ? uint8_t{0}
              : static_cast<uint8_t>(std::lround(kBlue + (kRed - kBlue) * std::clamp(color_share, 0.0, 1.0)));
    }
  }
  cv::applyColorMap(levels, rgb, cv::COLORMAP_TURBO);
  cv::cvtColor(rgb, rgb, cv::COLOR_BGR2RGB);
  rgb.setTo(cv::Scalar::all(255), depth_m == std::numeric_limits<float>::infinity());
  rgb.setTo(cv::Scalar::all(0), levels == 0);
  return rgb;
}

cv::Mat colored_flow(const cv::Mat& flow_px) {
  cv::Mat hsv(flow_px.size(), CV_8UC3);
  for (int row = 0; row < flow_px.rows; ++row) {
    for (int col = 0; col < flow_px.cols; ++col) {
      const auto& flow = flow_px.at<cv::Vec2f>(row, col);
      const double right = static_cast<double>(flow[0]), down = static_cast<double>(flow[1]);
      cv::Vec3b& color = hsv.at<cv::Vec3b>(row, col);
      color = {0, 0, 0};
      if (!std::isfinite(right + down)) continue;
      double turns = std::atan2(down, right) / (2.0 * std::numbers::pi);
      if (turns < 0.0) turns += 1.0;
      const double strength = std::min(1.0, std::hypot(right, down) / kFullColorPx);
      color = {static_cast<uint8_t>(std::lround(kHues * turns) % std::lround(kHues)),
               static_cast<uint8_t>(std::lround(255.0 * strength)), 255};
    }
  }
  return from_hsv(hsv);
}

cv::Mat colored_labels(const cv::Mat& labels) {
  constexpr double kGolden = 0.6180339887498949;  // golden ratio: neighboring labels get distant hues
  cv::Mat hsv(labels.size(), CV_8UC3);
  for (int row = 0; row < labels.rows; ++row) {
    for (int col = 0; col < labels.cols; ++col) {
      const int label = labels.at<int>(row, col);
      const double turns = label * kGolden - std::floor(label * kGolden);
      const auto hue = static_cast<uint8_t>(std::min(kHues - 1.0, std::floor(kHues * turns)));
      const auto saturation = static_cast<uint8_t>(150 + 35 * (label % 4));
      hsv.at<cv::Vec3b>(row, col) = label == 0 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(hue, saturation, 255);
    }
  }
  return from_hsv(hsv);
}

}  // namespace hedgehop::sim
