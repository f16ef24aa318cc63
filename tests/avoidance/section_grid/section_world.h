#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "avoidance/section_grid/section_grid.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::section_grid {

/// Boxes on level ground, a depth camera, and a point that follows commands.
class SectionWorld {
 public:
  static constexpr int kWidthPx = 96, kHeightPx = 54;
  static constexpr double kStepS = 0.08, kTurnRadps = 0.785, kClimbMps = 1.0;

  struct Moment {
    Eigen::Vector3d p_WB;
    std::string status;
    int section = -1, rows_above_center = 0;
  };
  struct Flown {
    bool reached = false;
    double clearance_m = std::numeric_limits<double>::infinity();  ///< of the point from the boxes
    std::vector<Moment> moments;
  };

  using Boxes = std::vector<Eigen::AlignedBox3d>;
  Boxes boxes_W;
  std::function<Boxes(double t_s)> movers_W;  ///< moving boxes; none if empty
  Eigen::Vector3d start_W{0.0, 0.0, -5.0}, goal_W{40.0, 0.0, -5.0};
  double speed_mps = 1.0, duration_s = 120.0;
  bool hovers = false;  ///< at its goal, to the end

  Flown fly(SectionGridConfig config) const {
    config.depth = stereo::DisparitySource::From::camera;
    const auto module = make_section_grid(config);
    MountedCamera camera = level_camera("depth", 0.0, kWidthPx, 1.0 / kStepS);
    const vision::camera::PinholeCamera lens = vision::camera::PinholeCamera::from_fov(kWidthPx, kHeightPx, 1.48);
    camera.model = lens;
    module->reset({{camera}, {speed_mps, 2.0, 0.64}, 1});
    Flown flown;
    Eigen::Vector3d p_WB = start_W;
    double heading_rad = 0.0;
    Command command = HoverCommand{};
    for (int64_t step = 1; static_cast<double>(step) * kStepS < duration_s; ++step) {
      Boxes boxes_now_W = boxes_W;
      if (movers_W) std::ranges::copy(movers_W(static_cast<double>(step) * kStepS), std::back_inserter(boxes_now_W));
      const cv::Mat depth_m = depth(boxes_now_W, lens, camera.X_BC, p_WB, heading_rad);
      const std::vector<CameraFrame> frames = {{"depth", step * 80'000'000, depth_m}};
      const Decision decision =
          module->update({step * 80'000'000, frames, level_flight(p_WB, heading_rad, {speed_mps, 0.0}), {goal_W, 0.0}});
      move(command, p_WB, heading_rad);
      command = decision.command;  // takes effect one step later
      flown.moments.push_back(
          {p_WB, decision.status, static_cast<int>(decision.signals[0]), static_cast<int>(decision.signals[3])});
      for (const Eigen::AlignedBox3d& box_W : boxes_now_W) {
        flown.clearance_m = std::min(flown.clearance_m, box_W.exteriorDistance(p_WB));
      }
      flown.reached = !hovers && (goal_W - p_WB).head<2>().norm() < 2.0;
      if (flown.reached || flown.clearance_m <= 0.0) break;
    }
    return flown;
  }

 private:
  static cv::Mat depth(const Boxes& boxes_now_W, const vision::camera::PinholeCamera& lens,
                       const Eigen::Isometry3d& X_BC, const Eigen::Vector3d& p_WB, double heading_rad) {
    Eigen::Isometry3d X_WB(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
    X_WB.translation() = p_WB;
    const Eigen::Isometry3d X_WC = X_WB * X_BC;
    cv::Mat depth_m(kHeightPx, kWidthPx, CV_32FC1);
    for (int v = 0; v < kHeightPx; ++v) {
      for (int u = 0; u < kWidthPx; ++u) {
        const Eigen::Vector3d ray_C((u - lens.center_u_px) / lens.focal_x_px, (v - lens.center_v_px) / lens.focal_y_px,
                                    1.0);
        depth_m.at<float>(v, u) = static_cast<float>(along(boxes_now_W, X_WC.translation(), X_WC.linear() * ray_C));
      }
    }
    return depth_m;
  }

  /// Distance along a ray to the first obstacle, in lengths of the ray.
  static double along(const Boxes& boxes_now_W, const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W) {
    double nearest = ray_W.z() > 0.0 ? -p_W.z() / ray_W.z() : std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& box_W : boxes_now_W) {
      const Eigen::Array3d a = (box_W.min() - p_W).array() / ray_W.array();
      const Eigen::Array3d b = (box_W.max() - p_W).array() / ray_W.array();
      const double enters = a.min(b).maxCoeff(), leaves = a.max(b).minCoeff();
      if (enters > 0.0 && enters <= leaves) nearest = std::min(nearest, enters);
    }
    return nearest;
  }

  void move(const Command& command, Eigen::Vector3d& p_WB, double& heading_rad) const {
    if (const auto* hover = std::get_if<HoverCommand>(&command)) heading_rad += kStepS * hover->yaw_rate_radps;
    const auto* const place = std::get_if<PositionCommand>(&command);
    if (!place) return;
    const double turn_rad = std::remainder(place->heading_rad - heading_rad, 2.0 * M_PI);
    heading_rad += std::clamp(turn_rad, -kStepS * kTurnRadps, kStepS * kTurnRadps);
    const Eigen::Vector3d path_W = place->p_WB - p_WB;
    const double level_m = path_W.head<2>().norm();
    if (level_m > 0.0) p_WB.head<2>() += path_W.head<2>() * std::min(1.0, kStepS * speed_mps / level_m);
    // A separate loop controls the altitude, like an autopilot.
    p_WB.z() += kStepS * std::clamp(path_W.z(), -kClimbMps, kClimbMps);
  }
};

}  // namespace hedgehop::avoidance::section_grid
