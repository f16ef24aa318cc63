#pragma once

#include <opencv2/core.hpp>

namespace hedgehop::sim {

// Color maps of numeric images: CV_8UC3, RGB. Unknown pixels are black.

inline constexpr double kMinColorM = 0.5, kMaxColorM = 200.0;
/// Returns a depth image in the colors of OpenCV's "turbo" map on a logarithmic scale: red up to 0.5 m, green at 10 m,
/// blue from 200 m. Sky is white. @param depth_m  as ImageChannel::depth.
cv::Mat colored_depth(const cv::Mat& depth_m);

inline constexpr double kFullColorPx = 16.0;
/// Returns a flow image. The hue is the direction: right red, down yellow-green, left cyan, up violet. The saturation
/// is the magnitude: white at 0 px, full color from 16 px. @param flow_px  as ImageChannel::flow.
cv::Mat colored_flow(const cv::Mat& flow_px);

/// Returns a label image with clearly different colors for neighboring labels; sky (0) is black. @param labels  as
/// ImageChannel::labels.
cv::Mat colored_labels(const cv::Mat& labels);

}  // namespace hedgehop::sim
