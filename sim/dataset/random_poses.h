#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "scenes/scene.h"
#include "sim/collision/proximity.h"

namespace hedgehop::sim {

/// Bounds of random poses.
struct PoseBounds {
  double min_height_m = 1.0, max_height_m = 20.0;      ///< above W's origin
  double max_tilt_rad = 0.35;                          ///< of roll and of pitch
  double min_distance_m = 1.0, max_distance_m = 30.0;  ///< between the hull and the nearest obstacle
  double max_speed_mps = 5.0, max_turn_radps = 0.5;    ///< of the motion to the next image
};

/// A body in free space, and its motion.
struct RandomPose {
  double t_s = 0.0;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< rad/s
  double clearance_m = 0.0;                          ///< to the nearest obstacle or the ground
};

/// Draws poses: the position is uniform over the scene's bounds and the heights, the heading uniform over the circle,
/// roll and pitch uniform over the tilts, the time uniform over the duration, velocity and turn rate uniform in balls;
/// a pose whose clearance is not within the distances, or that is above no surface in a scene without ground, is drawn
/// again. Equal arguments give equal poses.
/// Throws InputError if 20,000 draws in a row are not free.
std::vector<RandomPose> random_poses(size_t count, const PoseBounds& bounds, double duration_s,
                                     const scenes::Scene& scene, CollisionWorld& collision, uint64_t seed);

}  // namespace hedgehop::sim
