#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace hedgehop::avoidance::stereo_corridor {

/// Follows a pixel from image to image with the pyramidal Lucas-Kanade tracker. [Andert2007] sec. 4.3.2, eq. (15).
class TargetTracker {
 public:
  /// Returns where a pixel of the last image is in this one; nothing when it is lost or has left the image, or when
  /// there was no last image. This image becomes the last. @param grey  CV_8UC1.
  std::optional<cv::Point> follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey);

 private:
  cv::Mat last_;
};

}  // namespace hedgehop::avoidance::stereo_corridor
