#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "vision/flow_measures.h"
#include "vision/image_interpolation_flow.h"

namespace hedgehop::avoidance {

/// Mean flow and loom of one camera, from picture to picture.
class CameraFlow {
 public:
  struct Options {
    vision::ImageInterpolationConfig flow;
    bool derotate = false;
    vision::Missing missing = vision::Missing::far_away;
  };
  /// What the last pair of pictures told.
  struct Measure {
    double flow_radps = 0.0, loom_per_s = 0.0;
    double valid_share = 0.0;  ///< of the patches
    double dt_s = 0.0;         ///< between the two pictures
  };

  /// Throws std::invalid_argument when the camera is not a pinhole without distortion, or the patches do not fit its
  /// picture.
  CameraFlow(const MountedCamera& camera, const Options& options);

  /// Takes a picture in; one that is not newer than the last is left aside. @param w_WB_B  from the gyros, rad/s.
  /// @return true when there is a new measure.
  bool update(const CameraFrame& frame, const Eigen::Vector3d& w_WB_B);
  /// The newest measure; nothing before the second picture, or when it is older than three camera periods.
  std::optional<Measure> measure(int64_t now_ns) const;

  const MountedCamera& camera() const { return camera_; }
  const vision::PinholeCamera& pinhole() const { return pinhole_; }
  /// The last picture (CV_8UC1, empty before the first) and its flow (derotated when so configured).
  const cv::Mat& picture() const { return picture_; }
  const vision::FlowField& field() const { return field_; }

 private:
  MountedCamera camera_;
  vision::PinholeCamera pinhole_;
  Options options_;
  vision::ImageInterpolationFlow flow_;
  vision::FlowField field_;
  cv::Mat picture_;
  std::optional<int64_t> last_t_ns_;
  Eigen::Vector3d last_w_WB_B_ = Eigen::Vector3d::Zero();
  std::optional<Measure> measure_;
};

}  // namespace hedgehop::avoidance
