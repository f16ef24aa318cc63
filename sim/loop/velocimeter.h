#pragma once

#include <optional>

#include "dynamics/avionics.h"
#include "sim/loop/cameras.h"
#include "vision/flow/flow_velocity.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::sim {

/// The aircraft's own velocity sensor: optic flow of the camera that looks down, made metric by the height sensor and
/// derotated by the gyros. Source: [Garratt2009] sec. 4, after [GarrattChahl2007]
/// sec. 2 (hover damping by optic flow).
class Velocimeter {
 public:
  /// Throws std::invalid_argument if the camera is not an undistorted pinhole.
  Velocimeter(size_t camera, const Cameras& cameras);

  size_t camera() const { return camera_; }
  /// Measures the velocity by the flow since the last frame. @param frame  of the camera, later than the last.
  /// @param navigation  the estimate of the frame's time. @return none for the first frame, and if the ground has
  /// too little texture.
  std::optional<dynamics::VelocityReading> measure(const avoidance::CameraFrame& frame,
                                                   const dynamics::control::NavigationEstimate& navigation);

 private:
  /// The estimate at the exposure of a frame.
  struct Exposure {
    int64_t t_ns = 0;
    Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();
    double height_above_ground_m = 0.0;
  };

  size_t camera_;
  vision::camera::PinholeCamera pinhole_;
  Eigen::Isometry3d X_BC_;
  vision::flow::ImageInterpolationFlow flow_;
  std::optional<Exposure> last_;
};

}  // namespace hedgehop::sim
