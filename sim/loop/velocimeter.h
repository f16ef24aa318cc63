#pragma once

#include "dynamics/avionics.h"
#include "sim/loop/cameras.h"
#include "vision/image_interpolation_flow.h"

namespace hedgehop::sim {

/// The aircraft's own velocity sensor: optic flow of the camera that looks down, made metric by the height sensor and
/// derotated by the gyros, fed to the navigation filter. Source: [GarrattChahl2007]; [Garratt2009] sec. 4.
class Velocimeter {
 public:
  Velocimeter(size_t camera, const Cameras& cameras);

  size_t camera() const { return camera_; }
  /// Corrects the filter with the flow since the last frame; does nothing where the ground shows too little texture.
  void update(const avoidance::CameraFrame& frame, dynamics::Avionics& avionics);

 private:
  size_t camera_;
  avoidance::MountedCamera mounted_;
  vision::ImageInterpolationFlow flow_;
};

}  // namespace hedgehop::sim
