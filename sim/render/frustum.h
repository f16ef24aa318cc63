#pragma once

#include <Eigen/Geometry>
#include <array>

#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Nothing nearer than this is drawn, z in C.
inline constexpr double kNearPlaneM = 0.05;

/// What a camera can see: four side planes and the near plane, no far plane.
class Frustum {
 public:
  /// @param X_WC    pose of the camera. @param near_m  z in C of the near plane.
  Frustum(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, double near_m);

  /// False only when all of the box lies outside; sides are a pixel wider than the image.
  bool may_see(const Eigen::AlignedBox3f& box_W) const;

 private:
  struct Plane {
    Eigen::Vector3d n_W;  ///< inwards
    double offset = 0.0;  ///< n_W . p_W + offset >= 0 inside
  };
  std::array<Plane, 5> planes_;
};

}  // namespace hedgehop::sim
