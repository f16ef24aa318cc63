#pragma once

#include <optional>

#include "dynamics/avionics.h"
#include "sim/loop/cameras.h"
#include "vision/flow/ground_velocity.h"

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
  size_t camera_;
  vision::flow::GroundVelocity ground_;
};

}  // namespace hedgehop::sim
