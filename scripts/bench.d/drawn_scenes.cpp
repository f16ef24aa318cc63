#include "scripts/bench.d/drawn_scenes.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>

#include "scenes/generators.h"

namespace hedgehop::sim {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSidePx = 400;  // [Garratt2009] sec. 3.2

/// Camera looking along a heading, level.
Eigen::Isometry3d level(double north_m, double east_m, double height_m, double heading_rad) {
  Eigen::Isometry3d X_WC(Eigen::Translation3d(north_m, east_m, -height_m));
  X_WC.linear() << -std::sin(heading_rad), 0, std::cos(heading_rad),  //
      std::cos(heading_rad), 0, std::sin(heading_rad),                //
      0, 1, 0;
  return X_WC;
}

/// Straight down, north on top.
Eigen::Isometry3d down(double north_m, double east_m, double height_m) {
  Eigen::Isometry3d X_WC(Eigen::Translation3d(north_m, east_m, -height_m));
  X_WC.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return X_WC;
}

/// Returns a scene with its textures, so that no benchmark of drawing paints them.
scenes::Scene painted(const scenes::SceneConfig& config) {
  scenes::Scene scene = scenes::make_scene(config, 1);
  scene.textures.images();
  return scene;
}

}  // namespace

scenes::Scene city(double extent_m) {
  scenes::worlds::UrbanConfig config;
  config.extent_m = extent_m;
  return painted(config);
}

scenes::Scene room() { return painted(scenes::worlds::RoomConfig{}); }

scenes::Scene forest(int64_t trees) {
  return painted(scenes::worlds::ForestConfig{.trees = trees, .keep_clear = {{0.0, 0.0, 2.0}}});
}

scenes::Scene full_screen_quad() {
  constexpr double kTexelsPerPixel = 1.6;
  scenes::Scene scene;
  scene.textures = std::vector<cv::Mat>{city(300.0).textures.images().front()};
  const double texels_per_m = kTexelsPerPixel * right_angle_pinhole(kSidePx, kSidePx).focal_x_px / kFlightHeightM;
  const float half_m = 50.0f, repeats = static_cast<float>(texels_per_m * 50.0 / scene.textures.size_px());
  scenes::Mesh& mesh = scene.meshes.emplace_back();
  mesh.material = "opaque";
  for (const auto& [north, east] : {std::pair{-1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}, {1.f, -1.f}}) {
    scenes::Vertex& corner = mesh.vertices.emplace_back();
    corner.p_W = {half_m * north, half_m * east, 0.f};
    corner.uv = {repeats * north, repeats * east};
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.chunks = {{Eigen::AlignedBox3f(mesh.vertices[0].p_W, mesh.vertices[2].p_W), 0, 6, false}};
  return scene;
}

Poses street_views(double height_m) {
  Poses poses;
  for (const double north_m : {-60.0, 0.0, 60.0}) {
    for (const double east_m : {-30.0, 30.0}) {
      for (int k = 0; k < 8; ++k) poses.push_back(level(north_m, east_m, height_m, k * kPi / 4 + 0.1));
    }
  }
  return poses;
}

Poses five_cameras_in_flight() {
  Poses poses;
  for (double north_m = -130.0; north_m <= 110.0; north_m += 20.0) {
    for (int k = 0; k < 4; ++k) poses.push_back(level(north_m, 80.0, kFlightHeightM, k * kPi / 2));
    poses.push_back(down(north_m, 80.0, kFlightHeightM));
  }
  return poses;
}

Poses room_views() {
  Poses poses;
  for (int k = 0; k < 8; ++k) poses.push_back(level(-1.0, 0.5, 1.5, k * kPi / 4));
  return poses;
}

Poses forest_views(double height_m) {
  Poses poses;
  for (const auto& [north_m, east_m] : {std::pair{0.0, 0.0}, {8.0, 8.0}, {8.0, -8.0}, {-8.0, 8.0}, {-8.0, -8.0}}) {
    for (int k = 0; k < 8; ++k) poses.push_back(level(north_m, east_m, height_m, k * kPi / 4 + 0.1));
  }
  return poses;
}

Eigen::Isometry3d quad_view() { return down(0.0, 0.0, kFlightHeightM); }

vision::camera::PinholeCamera right_angle_pinhole(int width_px, int height_px) {
  return vision::camera::PinholeCamera::from_fov(width_px, height_px, kPi / 2);
}

vision::camera::Camera distorted_pinhole() {
  const vision::camera::PinholeCamera plain = right_angle_pinhole(kSidePx, kSidePx);
  vision::camera::PinholeLens lens{plain.focal_x_px, plain.focal_y_px, plain.center_u_px, plain.center_v_px};
  lens.k1 = -0.12;
  lens.k2 = 0.02;
  return {plain.width_px, plain.height_px, lens};
}

vision::camera::Camera wide_fisheye() {
  const double focal_px = vision::camera::fisheye_focal_px({}, 752, 190.0 * kPi / 180.0);
  return {752, 480, vision::camera::FisheyeLens{focal_px, focal_px, 375.5, 239.5}};
}

vision::camera::Camera floor_camera(int width_px, int height_px) {
  const double focal_px = right_angle_pinhole(kSidePx, kSidePx).focal_x_px;
  return vision::camera::PinholeCamera{
      width_px, height_px, focal_px, focal_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0};
}

}  // namespace hedgehop::sim
