#pragma once

#include <Eigen/Core>
#include <optional>

namespace hedgehop::avoidance::stereo_corridor {

/// Moves a vehicle that has no corridor away from an obstacle, back along its path. While it turns on the spot, it
/// drifts with the error of its position estimate, by up to 0.25 m/s, out of view of its cameras. Not in the
/// paper.
class Retreat {
 public:
  /// @param clearance_m  required distance from the nearest known obstacle during a turn on the spot, > 0.
  explicit Retreat(double clearance_m = 1.0) : clearance_m_(clearance_m) {}

  /// Returns the position to fly to before the vehicle may turn on the spot, in W, m: the last one with the required
  /// clearance. Empty if the clearance is sufficient, if there is no such position, or if the vehicle is there.
  /// Call it for every image. @param p_WB  position, m. @param nearest_m  distance of the nearest known obstacle from
  /// the hull, m; +infinity if there is none.
  std::optional<Eigen::Vector3d> update(const Eigen::Vector3d& p_WB, double nearest_m);

 private:
  double clearance_m_;
  std::optional<Eigen::Vector3d> clear_W_;
};

}  // namespace hedgehop::avoidance::stereo_corridor
