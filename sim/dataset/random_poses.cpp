#include "sim/dataset/random_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/config/input_error.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

/// Returns a vector drawn uniformly from the ball of a radius.
Eigen::Vector3d in_ball(Random& random, double radius) {
  for (;;) {
    Eigen::Vector3d v;
    for (double& coordinate : v) coordinate = uniform(random, -1.0, 1.0);
    if (v.squaredNorm() <= 1.0) return radius * v;
  }
}

RandomPose draw(Random& random, const PoseBounds& bounds, double duration_s, const Eigen::AlignedBox2d& plan_NE) {
  RandomPose pose;
  pose.t_s = uniform(random, 0.0, duration_s);
  const double north_m = uniform(random, plan_NE.min().x(), plan_NE.max().x());
  const double east_m = uniform(random, plan_NE.min().y(), plan_NE.max().y());
  const double height_m = uniform(random, bounds.min_height_m, bounds.max_height_m);
  const double yaw_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
  const double pitch_rad = uniform(random, -bounds.max_tilt_rad, bounds.max_tilt_rad);
  const double roll_rad = uniform(random, -bounds.max_tilt_rad, bounds.max_tilt_rad);
  pose.X_WB.linear() =
      (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  pose.X_WB.translation() = Eigen::Vector3d(north_m, east_m, -height_m);
  pose.v_WB_W = in_ball(random, bounds.max_speed_mps);
  pose.w_WB_B = in_ball(random, bounds.max_turn_radps);
  return pose;
}

}  // namespace

std::vector<RandomPose> random_poses(size_t count, const PoseBounds& bounds, double duration_s,
                                     const scenes::Scene& scene, CollisionWorld& collision, uint64_t seed) {
  constexpr int kMaxDraws = 20'000;
  if (scene.solids.empty() && scene.movers.empty()) {
    throw InputError(fmt::format("the scene has no obstacle, so no pose is {} to {} m from one", bounds.min_distance_m,
                                 bounds.max_distance_m));
  }
  Random random(seed);
  std::vector<RandomPose> poses;
  for (int draws = 0; poses.size() < count;) {
    RandomPose pose = draw(random, bounds, duration_s, scene.bounds_NE_m);
    const Proximity near = collision.query(pose.X_WB, bounds.max_distance_m + 1.0, pose.t_s);
    const bool is_above =
        scene.has_ground || std::isfinite(collision.height_above_surface(pose.X_WB.translation(), pose.t_s));
    const bool is_free = is_above && !near.collided && near.obstacle_clearance_m >= bounds.min_distance_m &&
                         near.obstacle_clearance_m <= bounds.max_distance_m && near.ground_clearance_m > 0.0;
    if (is_free) {
      pose.clearance_m = std::min(near.obstacle_clearance_m, near.ground_clearance_m);
      poses.push_back(pose);
      draws = 0;
    } else if (++draws == kMaxDraws) {
      throw InputError(fmt::format(
          "{} random poses in a row are not between {} and {} m from an obstacle; change --height or --distance",
          kMaxDraws, bounds.min_distance_m, bounds.max_distance_m));
    }
  }
  return poses;
}

}  // namespace hedgehop::sim
