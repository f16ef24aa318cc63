#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "avoidance/module.h"
#include "tests/vision/corridor/corridor_world.h"
#include "tests/vision/flow/textured_image.h"

/// A small rig of four level cameras and its images of textured walls, for tests of modules.
namespace hedgehop::avoidance {

/// Camera that looks along `azimuth_rad` (from forward to the right), level, at B's origin.
inline MountedCamera level_camera(std::string role, double azimuth_rad, int size_px, double rate_hz) {
  MountedCamera camera;
  camera.role = std::move(role);
  camera.model = vision::camera::PinholeCamera::from_fov(size_px, size_px, std::numbers::pi / 2);
  camera.rate_hz = rate_hz;
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  camera.X_BC.linear().col(0) = Eigen::Vector3d(-s, c, 0);  // image's right
  camera.X_BC.linear().col(1) = Eigen::Vector3d(0, 0, 1);   // image's down
  camera.X_BC.linear().col(2) = Eigen::Vector3d(c, s, 0);   // optical axis
  return camera;
}

inline Setup four_cameras(int size_px, double rate_hz, double speed_limit_mps = 10.0) {
  using std::numbers::pi;
  Setup setup;
  setup.cameras = {level_camera("front", 0.0, size_px, rate_hz), level_camera("right", 0.5 * pi, size_px, rate_hz),
                   level_camera("rear", pi, size_px, rate_hz), level_camera("left", -0.5 * pi, size_px, rate_hz)};
  setup.limits = {speed_limit_mps, 5.0, 1.0};
  setup.seed = 1;
  return setup;
}

/// Two level forward cameras, 0.3 m apart.
inline Setup stereo_pair(int size_px, double rate_hz, double speed_limit_mps = 10.0) {
  Setup setup;
  for (const char* role : {"left", "right"}) setup.cameras.push_back(level_camera(role, 0.0, size_px, rate_hz));
  setup.cameras.back().X_BC.translation().y() = 0.3;
  setup.limits = {speed_limit_mps, 5.0, 1.0};
  setup.seed = 1;
  return setup;
}

/// A fisheye of 190 degrees that looks down, for images as high as wide.
inline Setup fisheye_below(int size_px, double rate_hz, double speed_limit_mps = 10.0) {
  Setup setup;
  setup.cameras = {{"fisheye", vision::whole_fisheye(size_px, size_px), vision::looking_down(), rate_hz}};
  setup.limits = {speed_limit_mps, 5.0, 0.27};
  setup.seed = 1;
  return setup;
}

inline NavigationState level_flight(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector2d& v_WB_W) {
  NavigationState navigation;
  navigation.p_WB_est = p_WB;
  navigation.q_WB_est = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ());
  navigation.q_WB_gyro = navigation.q_WB_est;
  navigation.v_WB_B_est = navigation.q_WB_est.conjugate() * Eigen::Vector3d(v_WB_W.x(), v_WB_W.y(), 0.0);
  navigation.height_above_ground_m = -p_WB.z();
  return navigation;
}

/// Returns the image of the walls in every camera of the rig.
inline std::vector<CameraFrame> see(const Setup& setup, const NavigationState& navigation, int64_t t_ns,
                                    const std::vector<vision::TexturedPlane>& walls,
                                    const vision::WaveTexture& texture) {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = navigation.q_WB_est.toRotationMatrix();
  X_WB.translation() = navigation.p_WB_est;
  std::vector<CameraFrame> frames;
  for (const MountedCamera& camera : setup.cameras) {
    const Eigen::Isometry3d X_WC = X_WB * camera.X_BC;
    const bool straight = camera.model.is_undistorted_pinhole();
    frames.push_back({camera.role, t_ns,
                      straight ? vision::draw_planes(camera.model.pinhole(), X_WC, walls, texture)
                               : vision::draw_planes_through(camera.model, X_WC, walls, texture)});
  }
  return frames;
}

/// A vertical wall through a point, facing `normal_azimuth_rad` (from north to east).
inline vision::TexturedPlane wall(double north_m, double east_m, double normal_azimuth_rad,
                                  double half_width_m = std::numeric_limits<double>::infinity()) {
  return {{north_m, east_m, 0.0},
          {-std::sin(normal_azimuth_rad), std::cos(normal_azimuth_rad), 0.0},
          {0.0, 0.0, 1.0},
          half_width_m};
}

}  // namespace hedgehop::avoidance
