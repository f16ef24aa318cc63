#pragma once

#include <Eigen/Geometry>
#include <string>

namespace hedgehop::scenes {

/// A box that can be hit: faces at +-half_extents_m along the axes of S.
struct Solid {
  std::string name;
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Ones();  ///< > 0
};

}  // namespace hedgehop::scenes
