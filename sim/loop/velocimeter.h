#pragma once

#include <optional>

#include "dynamics/avionics.h"
#include "sim/loop/cameras.h"
#include "vision/flow/flow_velocity.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::sim {

/// The aircraft's own velocity sensor: optic flow of the camera that looks down, made metric by the height sensor and
/// derotated by the gyros, fed to the navigation filter. Source: [Garratt2009] sec. 4, after [GarrattChahl2007]
/// sec. 2 (hover damping by optic flow).
class Velocimeter {
 public:
  /// Throws std::invalid_argument when the camera is not an undistorted pinhole.
  Velocimeter(size_t camera, const Cameras& cameras);

  size_t camera() const { return camera_; }
  /// Corrects the filter with the flow since the last frame; does nothing where the ground shows too little texture.
  void update(const avoidance::CameraFrame& frame, dynamics::Avionics& avionics);

 private:
  /// What the aircraft believed of itself when the last frame was exposed.
  struct Belief {
    int64_t t_ns = 0;
    Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();
    double height_above_ground_m = 0.0;
  };

  size_t camera_;
  vision::camera::PinholeCamera pinhole_;
  Eigen::Isometry3d X_BC_;
  vision::flow::ImageInterpolationFlow flow_;
  std::optional<Belief> last_;
};

}  // namespace hedgehop::sim
