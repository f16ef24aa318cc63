#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace hedgehop::sim {

/// Returns the rotation about any axis and the translation, without scale, that bring points closest to their partners:
/// the minimum of the sum of squared distances, as a transform to apply to `from`.
/// @param from, to  partners at equal indices, m, of equal size.
/// @return std::nullopt with fewer than three pairs, or if all points are on one line, because the rotation about it is
/// free.
/// Source: [Umeyama1991] eq. (38) to (41), with scale 1.
std::optional<Eigen::Isometry3d> rigid_fit(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

/// Returns the rigid_fit() of a map to true corners. Corners and points of the map are matched one to one within 3,
/// then 1.5, then 1 tolerances, each time after the fit to the pairs before. A map that is displaced by more than 3
/// tolerances has no pairs.
/// @param corners_W, map_W  m. @param tolerance_m  > 0. @return std::nullopt as for rigid_fit().
std::optional<Eigen::Isometry3d> align_map(std::span<const Eigen::Vector3d> corners_W,
                                           std::span<const Eigen::Vector3d> map_W, double tolerance_m);

}  // namespace hedgehop::sim
