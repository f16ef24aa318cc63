#pragma once

#include <opencv2/core.hpp>

namespace hedgehop::sim {

// Images of numbers in colors for people, CV_8UC3, RGB. Unknown is black.

inline constexpr double kNearestColorM = 0.5, kFarthestColorM = 200.0;
/// Depth by its logarithm, in the colors of OpenCV's "turbo" map: red at 0.5 m and nearer, through yellow and green
/// (10 m) to blue at 200 m and farther. Sky is white. @param depth_m  as Channel::depth.
cv::Mat colored_depth(const cv::Mat& depth_m);

inline constexpr double kFullColorPx = 16.0;
/// Flow by its direction: right red, down yellow-green, left cyan, up violet; the paler the slower, white at rest, full
/// color at 16 px and faster. @param flow_px  as Channel::flow.
cv::Mat colored_flow(const cv::Mat& flow_px);

/// A color for each label that hardly any other has; sky (0) black. @param labels  as Channel::labels.
cv::Mat colored_labels(const cv::Mat& labels);

}  // namespace hedgehop::sim
