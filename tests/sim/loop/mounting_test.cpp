#include "sim/scenario/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "scenes/generators.h"
#include "sim/loop/cameras.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {
namespace {

constexpr double kRowErrorPx = 0.1, kBaselineM = 0.3, kBaselineError = 0.0005;

RigConfig stereo_rig(CameraConfig camera = {}) {
  RigConfig rig;
  rig.stereo = {
      {.baseline_m = kBaselineM, .row_error_px = kRowErrorPx, .baseline_error = kBaselineError, .camera = camera}};
  mount_rig(rig);
  return rig;
}

/// Pixel of a point given in the left camera's frame, seen from where a camera of the pair truly is.
Eigen::Vector2d seen(const RigConfig& rig, std::string_view role, const Eigen::Vector3d& p_C, uint64_t seed) {
  const CameraConfig& camera = *rig.find(role);
  const Eigen::Vector3d p_B = rig.find("left")->X_BC() * p_C;
  return *camera.model().project(true_X_BC(camera, camera.model(), seed).inverse() * p_B);
}

// Closed forms: a spot ahead is 0.1 px lower or higher in the right image, and its disparity f b / z is that of a
// baseline 0.05 % longer or shorter, near as well as far.
TEST(Mounting, APairMissesItsCalibrationByRowsAndByItsBaseline) {
  const RigConfig rig = stereo_rig({.width_px = 640, .height_px = 480, .focal_x_px = 600.0, .yaw_rad = 0.4});
  std::set<std::pair<bool, bool>> signs;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    for (const double z_m : {1.0, 5.0, 200.0}) {
      const Eigen::Vector3d spot_C(0.5 * kBaselineM, 0.0, z_m);  // ahead of the pair's middle
      const Eigen::Vector2d left = seen(rig, "left", spot_C, seed), right = seen(rig, "right", spot_C, seed);
      EXPECT_NEAR(std::abs(right.y() - left.y()), kRowErrorPx, 1e-6);
      const double nominal_px = 600.0 * kBaselineM / z_m, disparity_px = left.x() - right.x();
      EXPECT_NEAR(std::abs(disparity_px / nominal_px - 1.0), kBaselineError, 1e-6) << z_m;
      signs.insert({right.y() > left.y(), disparity_px > nominal_px});
    }
  }
  EXPECT_EQ(signs.size(), 4u);  // either sign of either error
}

TEST(Mounting, WithoutErrorsItIsThatOfTheCalibration) {
  const CameraConfig camera{.role = "a", .forward_m = 0.2, .yaw_rad = 0.3, .pitch_rad = -0.2};
  EXPECT_EQ(true_X_BC(camera, camera.model(), 3).matrix(), camera.X_BC().matrix());
}

TEST(Mounting, APixelsAngleIsOneOverTheFocalLength) {
  const CameraConfig pinhole{.width_px = 640, .height_px = 480, .focal_x_px = 500.0};
  EXPECT_NEAR(pixel_angle_rad(pinhole.model()), std::atan(1.0 / 500.0), 1e-12);
  const CameraConfig fisheye{.model_kind = CameraConfig::Model::fisheye, .width_px = 752, .focal_x_px = 144.0};
  EXPECT_NEAR(pixel_angle_rad(fisheye.model()), 1.0 / 144.0, 1e-9);  // r = f theta
}

// Images are rendered from the true pose; modules receive the calibrated pose.
TEST(Mounting, ImagesAreRenderedFromTheTruePoseAndModulesReceiveTheCalibration) {
  RigConfig rig = stereo_rig({.width_px = 160, .height_px = 120, .fov_rad = 1.1});
  rig.cameras[1].row_error_px = 3.0;
  const scenes::Scene scene = scenes::make_scene(scenes::worlds::TreeConfig{}, 1);
  constexpr uint64_t kSeed = 5;
  Renderer renderer(scene, Culling::frustum, RendererKind::tiles);
  Cameras cameras(rig, Ticks(500), scene, renderer, kSeed);
  const size_t right = cameras.index("right");
  EXPECT_EQ(cameras.mounted(right).X_BC.matrix(), rig.cameras[1].X_BC().matrix());

  BodyMotion body;
  body.X_WB.translation() = Eigen::Vector3d(-20.0, 0.0, -6.0);
  const cv::Mat delivered = cameras.expose(right, 0, body)->image.clone();
  const auto drawn = [&](const Eigen::Isometry3d& X_BC) {
    cv::Mat image;
    renderer.draw({cameras.mounted(right).model, body.X_WB * X_BC, ImageChannel::grey}, image);
    return image;
  };
  EXPECT_EQ(cv::norm(delivered, drawn(true_X_BC(rig.cameras[1], cameras.mounted(right).model, kSeed)), cv::NORM_INF),
            0.0);
  EXPECT_GT(cv::norm(delivered, drawn(rig.cameras[1].X_BC()), cv::NORM_INF), 10.0);
  EXPECT_EQ(cv::norm(delivered, cameras.snapshot(0, body.X_WB)[right].image, cv::NORM_INF), 0.0);  // and the film's
}

}  // namespace
}  // namespace hedgehop::sim
