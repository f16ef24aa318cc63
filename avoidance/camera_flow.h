#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "vision/flow/flow_measures.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance {

/// Mean flow and loom of one camera, from image to image.
class CameraFlow {
 public:
  struct Options {
    vision::flow::ImageInterpolationConfig flow;
    bool derotate = false;
    vision::flow::Missing missing = vision::flow::Missing::far_away;
  };
  /// What the last pair of images told.
  struct Measure {
    double flow_radps = 0.0, loom_per_s = 0.0;
    double valid_share = 0.0;  ///< of the patches
    double dt_s = 0.0;         ///< between the two images
  };

  /// Throws std::invalid_argument when the camera is not an undistorted pinhole, or the patches do not fit its
  /// image.
  CameraFlow(const MountedCamera& camera, const Options& options);

  /// Takes an image in; one that is not newer than the last is left aside. @param w_WB_B  from the gyros, rad/s.
  /// @return true when there is a new measure.
  bool update(const CameraFrame& frame, const Eigen::Vector3d& w_WB_B);
  /// The newest measure; nothing before the second image, or when it is older than three camera periods.
  std::optional<Measure> measure(int64_t now_ns) const;

  const MountedCamera& camera() const { return camera_; }
  const vision::camera::PinholeCamera& pinhole() const { return pinhole_; }
  /// The last image (CV_8UC1, empty before the first) and its flow (derotated when so configured).
  const cv::Mat& image() const { return image_; }
  const vision::flow::FlowField& field() const { return field_; }

 private:
  MountedCamera camera_;
  vision::camera::PinholeCamera pinhole_;
  Options options_;
  vision::flow::ImageInterpolationFlow flow_;
  vision::flow::FlowField field_;
  cv::Mat image_;
  std::optional<int64_t> last_t_ns_;
  Eigen::Vector3d last_w_WB_B_ = Eigen::Vector3d::Zero();
  std::optional<Measure> measure_;
};

}  // namespace hedgehop::avoidance
