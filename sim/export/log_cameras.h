#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/stereo/disparity_source.h"
#include "sim/export/log_sink.h"

namespace hedgehop::sim {

/// Whether a text is a name in topics, messages and plots: letters, digits and underscores, no digit first.
bool is_topic_word(std::string_view text);

/// Returns the cameras of a log: those with the roles, in this order, or all of the rig. Throws InputError for a role
/// that the rig lacks, and for a role that is no name of a topic (letters, digits and underscores).
std::vector<LoggedCamera> logged_cameras(const Scenario& scenario, const std::vector<std::string>& roles);

/// Matches the images of a stereo pair of the rig.
class PairDepth {
 public:
  /// @param left, right  numbers of the cameras. Throws std::invalid_argument as DisparitySource.
  PairDepth(const Scenario& scenario, std::span<const LoggedCamera> cameras, size_t left, size_t right);

  size_t left() const { return left_; }
  size_t right() const { return right_; }
  double baseline_m() const { return source_.geometry().baseline_m; }
  /// Returns the depth of the left image, CV_32FC1, z in C, m: infinite for a disparity of 0, NaN if unmatched; empty
  /// if the frames lack an image of the pair. Valid until the next call.
  const cv::Mat& match(std::span<const avoidance::CameraFrame> frames);

 private:
  size_t left_, right_;
  avoidance::stereo::DisparitySource source_;
  cv::Mat depth_m_;
};

/// Returns the stereo pairs among the cameras: equal parallel pinholes with grey images and roles left and right, or
/// with a common prefix, <prefix>_left and <prefix>_right. Marks the depth and baseline of their cameras.
std::vector<PairDepth> stereo_pairs(const Scenario& scenario, std::vector<LoggedCamera>& cameras);

}  // namespace hedgehop::sim
