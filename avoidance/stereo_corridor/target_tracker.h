#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace hedgehop::avoidance {

/// Follows a pixel from picture to picture with the pyramidal Lucas-Kanade tracker. [Andert2007] sec. 4.3.2, eq. (15).
class TargetTracker {
 public:
  /// Where a pixel of the last picture has gone in this one; nothing when it is lost or leaves the picture, or when
  /// there was no last picture. This picture becomes the last. @param grey  CV_8UC1.
  std::optional<cv::Point> follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey);

 private:
  cv::Mat last_;
};

}  // namespace hedgehop::avoidance
