#pragma once

#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "sim/fields/field.h"

namespace hedgehop::vision::stereo {

/// Method and parameters of stereo matching. describe() lists the parameters that depend on scene and camera; the other
/// defaults suit all pairs so far.
struct StereoMatcherConfig {
  enum class Method { block, semi_global };
  Method method = Method::semi_global;
  int disparities_px = 64;      ///< number of disparities, from 0; a multiple of 16
  int block_px = 5;             ///< side of the compared blocks, odd; for `block` at least 5
  int uniqueness_percent = 10;  ///< required margin of the best match over the second
  int texture = 10;             ///< minimum texture of a block; `block` only
  int left_right_px = 1;        ///< maximum difference of the matches from both sides; `block`: -1: not compared;
                                ///< `semi_global`: always compared, less than 1 counts as 1
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<StereoMatcherConfig> auto& c) {
  v("method", c.method,
    {.choices = {"block", "semi_global"},
     .meaning = "OpenCV's block matcher or semi-global matcher (five directions)"});
  v("disparities", c.disparities_px,
    {.unit = "px", .at_least = 16, .at_most = 512, .meaning = "number of disparities, from 0; a multiple of 16"});
  v("block", c.block_px, {.unit = "px", .at_least = 1, .at_most = 51, .meaning = "side of the compared blocks; odd"});
}

/// Return OpenCV's matchers. BlockMatcher and SemiGlobalMatcher give equal results in less time, for blocks up to their
/// maximum sizes.
cv::Ptr<cv::StereoMatcher> opencv_block(const StereoMatcherConfig& config);
cv::Ptr<cv::StereoMatcher> opencv_semi_global(const StereoMatcherConfig& config);

/// Computes the disparity of rectified grey pairs. Reuses its memory; equal pairs give equal disparities.
class StereoMatcher {
 public:
  /// Throws std::invalid_argument "<key>: ..." if OpenCV would reject the config.
  explicit StereoMatcher(const StereoMatcherConfig& config);
  StereoMatcher(StereoMatcher&&) noexcept;
  StereoMatcher& operator=(StereoMatcher&&) noexcept;
  ~StereoMatcher();

  /// Computes the disparity. @param left, right  CV_8UC1, of equal size, rectified. @param disparity16  of the left
  /// image, as in vision/stereo/disparity.h. Throws std::invalid_argument on different sizes or types.
  void match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16);

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace hedgehop::vision::stereo
