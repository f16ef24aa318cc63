#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// A map of where the sun's light ends: the depth of all that stands still as seen from there, 1 nearest to the sun and
/// 0 farthest.
struct SunPlan {
  std::vector<scenes::Chunk> casters;  ///< what is drawn into it
  int texels = 0;                      ///< a side
  /// From p_W, m, to the position in the map: column and row, 0..1 from its first texel to its last, and depth.
  Eigen::Affine3d from_W = Eigen::Affine3d::Identity();
};

/// Plans as many texels as shadows 0.05 m fine need, within 2048 to 4096 a side. Movers and flat chunks cast no shadow:
/// below the ground there is nothing, and a room's ceiling would darken all of it.
/// @param to_sun_W  any length but 0.
SunPlan plan_sun_map(const std::vector<scenes::Chunk>& chunks, const Eigen::Vector3f& to_sun_W);

/// A surface lies deeper in the map by this times what it rises on a texel: it is compared with four texels, each less
/// than one away along both axes, and would darken itself.
inline constexpr double kSunSlack = 2.0;

}  // namespace hedgehop::sim
