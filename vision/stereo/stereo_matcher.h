#pragma once

#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "sim/fields/field.h"

namespace hedgehop::vision::stereo {

/// Which of OpenCV's matchers turns a rectified pair into disparity, and how. describe() lists what a scene and a
/// camera decide; the other values fit every pair so far.
struct StereoMatcherConfig {
  enum class Method { block, semi_global };
  Method method = Method::semi_global;
  int disparities_px = 64;      ///< searched: 0 to this, less one; a multiple of 16
  int block_px = 5;             ///< side of the compared squares, odd; for `block` at least 5
  int uniqueness_percent = 10;  ///< by which the best match must beat the second
  int texture = 10;             ///< least texture of a square; `block` only
  int left_right_px = 1;        ///< by which matching from either side may differ; -1: not compared
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<StereoMatcherConfig> auto& c) {
  v("method", c.method,
    {.choices = {"block", "semi_global"},
     .meaning = "OpenCV's block matcher, or its semi-global one (five directions)"});
  v("disparities", c.disparities_px,
    {.unit = "px", .at_least = 16, .at_most = 512, .meaning = "disparities searched from 0 on; a multiple of 16"});
  v("block", c.block_px, {.unit = "px", .at_least = 1, .at_most = 51, .meaning = "side of the compared squares; odd"});
}

/// OpenCV's matcher that `semi_global` is. SemiGlobalMatcher finds the same in less time, for squares that it takes.
cv::Ptr<cv::StereoMatcher> opencv_semi_global(const StereoMatcherConfig& config);

/// Disparity of rectified grey pairs. Keeps its memory from pair to pair; equal pairs give equal disparities.
class StereoMatcher {
 public:
  /// Throws std::invalid_argument "<key>: ..." on a config that OpenCV would not take.
  explicit StereoMatcher(const StereoMatcherConfig& config);
  StereoMatcher(StereoMatcher&&) noexcept;
  StereoMatcher& operator=(StereoMatcher&&) noexcept;
  ~StereoMatcher();

  /// @param left, right  CV_8UC1, of one size, rectified. @param disparity16  as in vision/stereo/disparity.h, of the
  /// left. Throws std::invalid_argument when the images do not fit together.
  void match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16);

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace hedgehop::vision::stereo
