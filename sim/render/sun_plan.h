#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// Layout of a shadow map: depths of all static solids seen from the sun, from 1 (at the sun side) to 0 (at the far
/// side).
struct SunPlan {
  std::vector<scenes::Chunk> casters;  ///< chunks that cast shadows
  int texels = 0;                      ///< per side
  /// Transformation from p_W, m, to the position in the map: column and row, 0..1 across the map, and depth.
  Eigen::Affine3d from_W = Eigen::Affine3d::Identity();
};

/// Returns the layout of the shadow map. The map has 2048 texels per side if they are at most 0.05 m wide, else 4096.
/// Moving obstacles and flat chunks cast no shadow: the ground has no surface below it, and a ceiling would darken its
/// whole room.
/// @param to_sun_W  of any length but 0.
SunPlan plan_sun_map(const std::vector<scenes::Chunk>& chunks, const Eigen::Vector3f& to_sun_W);

/// Depth offset of surfaces in the map, in units of their depth change per texel. A point is compared with four texels,
/// each less than one texel away along both axes. Without the offset, surfaces would shade themselves.
inline constexpr double kSunSlack = 2.0;

}  // namespace hedgehop::sim
