#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "sim/scenario/rig.h"

namespace hedgehop::sim {

/// Degrades one camera's images as configured. The result depends on the image's number and the camera's seed, and on
/// the gain of automatic exposure, which only expose() changes.
class Imperfections {
 public:
  /// @param period_s  between images, > 0. @param seed  of the camera's own stream. @param focal_px  of the lens, > 0;
  /// for disparity noise only.
  Imperfections(const ImperfectionsConfig& config, double period_s, uint64_t seed, double focal_px = 0.0);

  /// Fault of a frame.
  enum class FrameFault { none, dropped, frozen, black };
  FrameFault frame_fault(int64_t frame) const;

  /// Adapts automatic exposure to an image that the sensor takes. apply() must follow. @param image  CV_8U; others have
  /// no exposure.
  void expose(const cv::Mat& image);
  /// Applies vignetting and pixel gains, exposure, photon noise and read noise, in this physical order; grey levels are
  /// proportional to light. To depth it applies disparity noise; a disparity of 0 or less becomes infinite depth.
  /// @param image  CV_8U, or CV_32FC1 of depth, z in C, m, NaN unknown; others are left as they are.
  void apply(int64_t frame, cv::Mat& image) const;

 private:
  bool is_uneven() const { return config_.vignetting > 0.0 || config_.fixed_pattern > 0.0; }
  void apply_to_depth(int64_t frame, cv::Mat& depth_m) const;
  const cv::Mat& response_for(const cv::Mat& image) const;

  ImperfectionsConfig config_;
  double period_s_;
  uint64_t seed_;
  double focal_px_;
  double gain_;
  mutable cv::Mat response_;        ///< CV_32F, as many channels as the image; a cache
  mutable cv::Mat levels_, noise_;  ///< CV_32F; scratch
};

/// Sets an image to the output of a dead sensor: 0 in 8 bits, NaN (unknown) in floats.
void blank(cv::Mat& image);

}  // namespace hedgehop::sim
