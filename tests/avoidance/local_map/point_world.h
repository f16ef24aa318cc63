#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "avoidance/local_map/local_map.h"
#include "sim/libm/random.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::local_map {

/// Vertical cylinders and walls on level ground, a depth camera without error, and a vehicle that follows velocities
/// with a delay and limited acceleration. An independent oracle: it shares no code with the map or the planner.
class PointWorld {
 public:
  struct Pillar {
    Eigen::Vector2d p_W;
    double radius_m;
    Eigen::Vector2d v_W = Eigen::Vector2d::Zero();
  };
  struct Wall {
    Eigen::Vector2d from_W, to_W;
    double thickness_m = 0.4;
  };
  struct Flown {
    bool reached = false;
    double clearance_m = std::numeric_limits<double>::infinity();  ///< of the hull
    double length_m = 0.0, time_s = 0.0, fastest_mps = 0.0;
    Eigen::Vector2d end_W = Eigen::Vector2d::Zero();
    std::string status;
    std::vector<std::string> statuses;
    struct At {
      double t_s;
      Eigen::Vector2d p_W, v_W;
      double heading_rad;
    };
    std::vector<At> track;  ///< one per image
  };

  static constexpr double kStepS = 0.1;

  int width_px = 160, height_px = 72;  ///< of the depth camera

  std::vector<Pillar> pillars;
  std::vector<Wall> walls;
  Eigen::Vector2d start_W{0.0, 0.0}, goal_W{30.0, 0.0};
  double height_m = 3.0, radius_m = 0.0, duration_s = 90.0, reached_m = 1.5;
  double speed_mps = 8.0, acceleration_mps2 = 3.0;
  bool looks_aft = false;                                         ///< has a second depth camera
  double blind_from_s = std::numeric_limits<double>::infinity();  ///< from then on every pixel is unknown
  std::vector<Eigen::AlignedBox3d> outline_B;                     ///< of the vehicle; empty: a disc of radius_m
  std::optional<double> heading_rad;                              ///< at the start; towards the goal if empty
  std::function<void(const Eigen::Vector2d&, double, const Decision&, const Module&)> watch;

  Flown fly(LocalMapConfig config) const {
    config.depth = stereo::DisparitySource::From::camera;
    if (looks_aft) config.pairs = {"aft"};
    const auto module = make_local_map(config);
    const vision::camera::PinholeCamera lens = vision::camera::PinholeCamera::from_fov(width_px, height_px, 1.48);
    std::vector<MountedCamera> cameras = {level_camera("depth", 0.0, width_px, 1.0 / kStepS)};
    if (looks_aft) cameras.push_back(level_camera("aft_depth", M_PI, width_px, 1.0 / kStepS));
    for (MountedCamera& camera : cameras) camera.model = lens;
    module->reset({cameras, {speed_mps, acceleration_mps2, radius_m, outline_B}, 1});
    Flown flown;
    Eigen::Vector2d p_W = start_W, v_W = Eigen::Vector2d::Zero();
    double nose_rad = heading_rad.value_or(std::atan2(goal_W.y() - start_W.y(), goal_W.x() - start_W.x()));
    VelocityCommand obeyed{v_W, height_m, nose_rad};
    for (int64_t step = 0; static_cast<double>(step) * kStepS < duration_s; ++step) {
      flown.time_s = static_cast<double>(step) * kStepS;
      const int64_t t_ns = step * 100'000'000;
      const cv::Mat depth_m = flown.time_s >= blind_from_s ? cv::Mat(height_px, width_px, CV_32FC1, std::nan(""))
                                                           : depth(lens, p_W, nose_rad, flown.time_s);
      std::vector<CameraFrame> frames = {{"depth", t_ns, depth_m}};
      if (looks_aft) frames.push_back({"aft_depth", t_ns, depth(lens, p_W, nose_rad + M_PI, flown.time_s)});
      const NavigationState navigation = level_flight({p_W.x(), p_W.y(), -height_m}, nose_rad, v_W);
      const Decision decision = module->update({t_ns, frames, navigation, {{goal_W.x(), goal_W.y(), -height_m}, 0.0}});
      flown.statuses.push_back(decision.status);
      flown.track.push_back({flown.time_s, p_W, v_W, nose_rad});
      if (watch) watch(p_W, flown.time_s, decision, *module);
      // A decision takes effect one image later.
      for (int part = 0; part < 5; ++part) {
        move(obeyed, kStepS / 5, p_W, v_W, nose_rad);
        flown.clearance_m = std::min(flown.clearance_m, hull_clearance_m(p_W, nose_rad, flown.time_s));
      }
      flown.length_m += kStepS * v_W.norm();
      flown.fastest_mps = std::max(flown.fastest_mps, v_W.norm());
      if (const auto* command = std::get_if<VelocityCommand>(&decision.command)) obeyed = *command;
      flown.reached = (goal_W - p_W).norm() < reached_m;
      if (flown.reached || flown.clearance_m <= 0.0) break;
    }
    flown.end_W = p_W;
    flown.status = flown.statuses.back();
    return flown;
  }

  /// Distance from a point to the nearest surface.
  double distance_m(const Eigen::Vector2d& p_W, double t_s) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Pillar& pillar : pillars) {
      least_m = std::min(least_m, (pillar.p_W + t_s * pillar.v_W - p_W).norm() - pillar.radius_m);
    }
    for (const Wall& wall : walls) {
      const Eigen::Vector2d along_W = wall.to_W - wall.from_W;
      const double share = std::clamp((p_W - wall.from_W).dot(along_W) / along_W.squaredNorm(), 0.0, 1.0);
      least_m = std::min(least_m, (wall.from_W + share * along_W - p_W).norm() - 0.5 * wall.thickness_m);
    }
    return least_m;
  }

 private:
  /// Clearance of a disc, or of points along the edges of the boxes of the hull.
  double hull_clearance_m(const Eigen::Vector2d& p_W, double nose_rad, double t_s) const {
    if (outline_B.empty()) return distance_m(p_W, t_s) - radius_m;
    double least_m = std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& box : outline_B) {
      constexpr int kPoints = 12;
      for (int i = 0; i <= kPoints; ++i) {
        for (const double side : {0.0, 1.0}) {
          const double share = static_cast<double>(i) / kPoints;
          for (const Eigen::Vector2d& at : {Eigen::Vector2d(share, side), Eigen::Vector2d(side, share)}) {
            const Eigen::Vector2d p_B = box.min().head<2>() + at.cwiseProduct(box.sizes().head<2>());
            least_m = std::min(least_m, distance_m(p_W + Eigen::Rotation2Dd(nose_rad) * p_B, t_s));
          }
        }
      }
    }
    return least_m;
  }

  void move(const VelocityCommand& command, double dt_s, Eigen::Vector2d& p_W, Eigen::Vector2d& v_W,
            double& nose_rad) const {
    constexpr double kLagS = 0.4, kTurnRadps = 0.785;
    Eigen::Vector2d a_W = (command.v_WB_W - v_W) / kLagS;
    if (a_W.norm() > acceleration_mps2) a_W *= acceleration_mps2 / a_W.norm();
    v_W += dt_s * a_W;
    p_W += dt_s * v_W;
    const double turn_rad = std::remainder(command.heading_rad - nose_rad, 2.0 * M_PI);
    nose_rad += std::clamp(turn_rad, -dt_s * kTurnRadps, dt_s * kTurnRadps);
  }

  /// Sphere tracing in the plane: all obstacles are vertical and infinitely high.
  cv::Mat depth(const vision::camera::PinholeCamera& lens, const Eigen::Vector2d& p_W, double nose_rad,
                double t_s) const {
    constexpr double kFarM = 80.0, kNearM = 1e-3;
    const Eigen::Vector2d ahead_W(std::cos(nose_rad), std::sin(nose_rad)), right_W(-ahead_W.y(), ahead_W.x());
    cv::Mat depth_m(height_px, width_px, CV_32FC1);
    for (int u = 0; u < width_px; ++u) {
      const double side = (u - lens.center_u_px) / lens.focal_x_px;
      const Eigen::Vector2d ray_W = (ahead_W + side * right_W).normalized();
      double s_m = 0.0;
      while (s_m < kFarM) {
        const double away_m = distance_m(p_W + s_m * ray_W, t_s);
        if (away_m < kNearM) break;
        s_m += away_m;
      }
      const double z_m = s_m < kFarM ? s_m / std::hypot(1.0, side) : std::numeric_limits<double>::infinity();
      for (int v = 0; v < height_px; ++v) {
        const double down = (v - lens.center_v_px) / lens.focal_y_px;
        const double ground_m = down > 0.0 ? height_m / down : std::numeric_limits<double>::infinity();
        depth_m.at<float>(v, u) = static_cast<float>(std::min(z_m, ground_m));
      }
    }
    return depth_m;
  }
};

/// A world of pillars and walls between start and goal, with free space around both.
inline PointWorld random_world(uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return hedgehop::uniform(random, low, high); };
  PointWorld world;
  world.goal_W = {uniform(12.0, 28.0), uniform(-6.0, 6.0)};
  world.acceleration_mps2 = uniform(1.5, 4.0);
  const int pillars = 4 + static_cast<int>(uniform(0.0, 18.0)), walls = static_cast<int>(uniform(0.0, 4.0));
  const auto clear = [&](double keep_m) {
    return world.distance_m(world.start_W, 0.0) > keep_m && world.distance_m(world.goal_W, 0.0) > 1.0;
  };
  constexpr double kStartClearM = 2.5;
  for (int i = 0; i < pillars; ++i) {
    world.pillars.push_back({{uniform(-4.0, 34.0), uniform(-14.0, 14.0)}, uniform(0.1, 1.5)});
    if (!clear(kStartClearM)) world.pillars.pop_back();
  }
  for (int i = 0; i < walls; ++i) {
    const Eigen::Vector2d from_W(uniform(2.0, 26.0), uniform(-12.0, 12.0));
    const double azimuth_rad = uniform(0.0, 2.0 * M_PI);
    world.walls.push_back(
        {from_W, from_W + uniform(3.0, 14.0) * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad))});
    if (!clear(kStartClearM)) world.walls.pop_back();
  }
  return world;
}

/// Two or three pillars that cross the route and are timed to meet the vehicle.
inline PointWorld traffic(uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return hedgehop::uniform(random, low, high); };
  PointWorld world;
  world.width_px = 640;
  world.height_px = 288;
  world.radius_m = 0.65;
  world.goal_W = {30.0, 0.0};
  const int count = 2 + static_cast<int>(uniform(0.0, 2.0));
  for (int k = 0; k < count; ++k) {
    const double speed_mps = uniform(0.5, 3.0), azimuth = (uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0) * uniform(1.0, 2.1);
    const Eigen::Vector2d v_W = speed_mps * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    const Eigen::Vector2d meets_W(uniform(8.0, 26.0), 0.0);
    const double at_s = uniform(0.15, 0.8) * meets_W.x();
    world.pillars.push_back({meets_W - at_s * v_W, uniform(0.3, 1.2), v_W});
  }
  return world;
}

}  // namespace hedgehop::avoidance::local_map
