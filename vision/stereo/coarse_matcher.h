#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::vision::stereo {

/// Matches areas with too little contrast for a block matcher again, at lower resolutions. Windows then cover more of
/// the surface, and averaging reduces the noise of the camera. Like [Kanade1994] p. 920, larger windows are used only
/// if smaller ones do not suffice, because they blur the edges of surfaces. Differs: the windows grow by the reduction
/// of the images, not with a model of the surface.
class CoarseMatcher {
 public:
  /// @param fine  config of the block matcher. Throws std::invalid_argument as StereoMatcher does.
  explicit CoarseMatcher(const StereoMatcherConfig& fine);

  /// Fills unmatched pixels of little contrast. Matches that may belong to an adjacent surface are not used.
  /// @param left, right  CV_8UC1, of equal size, rectified. @param fine_sigma_px  1-sigma error of the given
  /// disparities; at 1 / n of the resolution it is n times as large. @param disparity16  of the left image, filled in
  /// place.
  /// @param sigma16  CV_16SC1, 1-sigma error of the disparity x 16 of all pixels. @return number of filled pixels.
  int fill(const cv::Mat& left, const cv::Mat& right, double fine_sigma_px, cv::Mat& disparity16, cv::Mat& sigma16);

 private:
  struct Level {
    int reduction;
    StereoMatcher matcher;
    cv::Mat left, right, disparity16, smeared;
  };
  int half_window_px_;
  cv::Mat contrast_;  ///< range of grey levels near each pixel
  std::vector<Level> levels_;
};

}  // namespace hedgehop::vision::stereo
