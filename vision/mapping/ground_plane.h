#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "vision/mapping/depth_blocks.h"
#include "vision/mapping/upright_columns.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// Returns the ray in C, scaled to z = 1, of the lower border of a block, which shows the nearest ground in the block.
Eigen::Vector3d lower_border_ray(const stereo::StereoGeometry& geometry, int row, int col);

/// A plane of ground. Its disparity is linear in the ray. [Labayrade2002] p. 646 uses that it is linear in the image
/// row. Differs: the camera may roll.
struct GroundPlane {
  static constexpr double kWithin16 = 24.0;  ///< maximum difference of its matches: three sigma of a disparity x 16
  static constexpr int kMaxGap = 2;          ///< maximum unmatched blocks within the ground of a column

  Eigen::Vector3d slope_C;  ///< downward normal in C x 16 focal length x baseline / height

  /// @param ray_C  scaled to z = 1. @return disparity x 16; negative above the horizon.
  double disparity16(const Eigen::Vector3d& ray_C) const { return slope_C.dot(ray_C); }
  /// Returns whether the nearest surface of a block is on the plane. @param ray_C  of the lower border of the block.
  bool contains(const DepthBlock& block, const Eigen::Vector3d& ray_C) const {
    return block.near16 >= 0 && std::abs(block.near16 - disparity16(ray_C)) <= kWithin16;
  }
};

/// Fits a plane to the matches next to the lower border of the image. The attitude gives its normal within a few
/// hundredths; the matches give its height and the rest of the normal.
/// @param down_C  unit vector of the vertical in C. @return empty if there are too few matches on a plane.
std::optional<GroundPlane> fit_ground(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C,
                                      const UprightColumns& columns);

}  // namespace hedgehop::vision::mapping
