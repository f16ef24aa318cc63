#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "vision/flow/flow_measures.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance {

/// Returns the estimated velocity of a camera that is mounted at `X_BC`, in C, m/s.
Eigen::Vector3d velocity_in_camera(const Eigen::Isometry3d& X_BC, const NavigationState& navigation);

/// Mean flow and loom of one camera from image to image.
class CameraFlow {
 public:
  struct Options {
    vision::flow::ImageInterpolationConfig flow;
    bool derotate = false;
    vision::flow::Missing missing = vision::flow::Missing::far_away;
  };
  /// Measurements from the last two images.
  struct Measure {
    double flow_radps = 0.0;   ///< mean horizontal flow Q, positive to the right in the image
    double loom_per_s = 0.0;   ///< loom L, > 0 when approaching
    double valid_share = 0.0;  ///< of the patches, 0 to 1
    double dt_s = 0.0;         ///< between the two images, > 0
  };

  /// Throws std::invalid_argument if the camera is not an undistorted pinhole or the patches do not fit its image.
  CameraFlow(const MountedCamera& camera, const Options& options);

  /// Adds an image. An image that is not newer than the last one is ignored.  @param w_WB_B  from the gyros, rad/s.
  /// @return whether there is a new measurement.
  bool update(const CameraFrame& frame, const Eigen::Vector3d& w_WB_B);
  /// Returns the newest measurement; empty before the second image, or if the measurement is older than three camera
  /// periods.
  std::optional<Measure> measure(int64_t now_ns) const;

  const MountedCamera& camera() const { return camera_; }
  const vision::camera::PinholeCamera& pinhole() const { return pinhole_; }
  /// The last image (CV_8UC1, empty before the first) and its flow (derotated if so configured).
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
