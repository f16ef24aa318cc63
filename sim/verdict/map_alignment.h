#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace hedgehop::sim {

/// Returns the rotation about the vertical and the translation that bring the points of a map closest to true corners,
/// as a transform to apply to the map. Navigation knows the vertical from gravity, so the map is not tilted. The pairs
/// are matched within 3, then 1.5 tolerances, each time after the alignment by the pairs before.
/// @param corners_W, map_W  m. @param tolerance_m  > 0.
/// @return std::nullopt with fewer than two pairs.
/// Source: [ZhangScaramuzza2018] sec. III-B, alignment in position and heading.
std::optional<Eigen::Isometry3d> align_map(std::span<const Eigen::Vector3d> corners_W,
                                           std::span<const Eigen::Vector3d> map_W, double tolerance_m);

}  // namespace hedgehop::sim
