#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/rig.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/spot_image.h"
#include "tests/sim/render/tested_renderer.h"
#include "tests/sim/render/whole_fisheye.h"
#include "tests/vision/camera/random_lenses.h"

/// Compares the position of drawn points with their projection by the lens model.
namespace hedgehop::sim {
namespace {

using vision::camera::Camera;

constexpr double kPinholeRmsPx = 0.05, kFisheyeRmsPx = 0.1;

Camera ocam() { return Camera(vision::camera::parse_ocam_calibration(vision::kSmallCalibration)); }

/// A white spot, 1 m wide, on the plane x = 0 that fades to black, seen from the south, in front of black.
SmallWorld spot() {
  SmallWorld world(std::vector{spot_image(64)});
  world.scene.sky = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  world.scene.lights = {.ambient = 1.0f, .sun = 0.0f};
  world.add_quad({0, -0.5f, -0.5f}, {0, 1, 0}, {0, 0, 1});
  return world;
}

/// Returns the pose from which the spot, seen perpendicularly from `distance_m`, is at the pixel of a ray in C.
Eigen::Isometry3d facing(const Eigen::Vector3d& ray_C, double distance_m, double roll_rad) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.translation().x() = -distance_m;
  const Eigen::Vector3d north = Eigen::Vector3d::UnitX();
  X_WC.linear() = (Eigen::AngleAxisd(roll_rad, north) * Eigen::Quaterniond::FromTwoVectors(ray_C, north)).matrix();
  return X_WC;
}

/// Returns the root mean square distance between drawn spots and the projections of their centers over the whole image.
double spot_rms_px(Renderer& renderer, const Camera& camera, double focal_px, int spots, std::mt19937_64& random) {
  constexpr double kSpotPx = 14.0;
  double sum_squares = 0.0;
  int drawn = 0;
  cv::Mat grey;
  while (drawn < spots) {
    const Eigen::Vector2d pixel(uniform(random, 12, camera.width_px - 12), uniform(random, 12, camera.height_px - 12));
    const auto ray_C = camera.unit_ray(pixel);
    if (!ray_C) continue;
    const Eigen::Isometry3d X_WC = facing(*ray_C, focal_px / kSpotPx, uniform(random, 0, 6.28));
    renderer.draw({camera, X_WC, ImageChannel::grey}, grey);
    const auto expected = camera.project(X_WC.inverse() * Eigen::Vector3d::Zero());
    sum_squares += (centroid(grey) - *expected).squaredNorm();
    ++drawn;
  }
  return std::sqrt(sum_squares / spots);
}

TEST(LensImage, DrawsSpotsAtTheirProjectionThroughADistortedPinhole) {
  Renderer renderer = make_renderer(spot().scene);
  std::mt19937_64 random(201);
  for (int trial = 0; trial < 3; ++trial) {
    const Camera camera = vision::random_distorted_pinhole(random);
    const double rms_px = spot_rms_px(renderer, camera, 375.0, 80, random);
    RecordProperty("rms_px_" + std::to_string(trial), std::to_string(rms_px));
    EXPECT_LT(rms_px, kPinholeRmsPx) << "trial " << trial;
  }
}

TEST(LensImage, DrawsSpotsAtTheirProjectionThroughAFisheye) {
  Renderer renderer = make_renderer(spot().scene);
  std::mt19937_64 random(202);
  const std::vector<std::pair<std::string, Camera>> cameras = {
      {"195_deg", fisheye(400, 400, 195)}, {"190_deg_wide", fisheye(752, 480, 190)}, {"ocam", ocam()}};
  for (const auto& [name, camera] : cameras) {
    const double rms_px = spot_rms_px(renderer, camera, 0.55 * camera.width_px / 2.0, 100, random);
    RecordProperty("rms_px_" + name, std::to_string(rms_px));
    EXPECT_LT(rms_px, kFisheyeRmsPx) << name;
  }
}

TEST(LensImage, StereoPairShowsAPointOnOneRowAtItsDisparity) {
  Renderer renderer = make_renderer(spot().scene);
  std::mt19937_64 random(209);
  cv::Mat left, right;
  double worst_row_px = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    RigConfig rig;
    StereoConfig& pair = rig.stereo.emplace_back();
    pair.baseline_m = uniform(random, 0.05, 0.6);
    pair.camera.width_px = 320;
    pair.camera.height_px = 240;
    pair.camera.yaw_rad = uniform(random, -3, 3);
    pair.camera.pitch_rad = uniform(random, -1.5, 1.5);
    pair.camera.roll_rad = uniform(random, -3, 3);
    mount_rig(rig);
    const vision::camera::PinholeCamera camera = rig.cameras[0].model().pinhole();
    // The spot is parallel to the image plane, at a random position of the left image.
    const double z_m = uniform(random, 6.0, 14.0);
    const Eigen::Vector3d p_C = z_m * camera.ray_at_unit_depth({uniform(random, 80, 290), uniform(random, 30, 210)});
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    X_WC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    X_WC.translation() = -(X_WC.linear() * p_C);
    const Eigen::Isometry3d X_WCr = X_WC * rig.cameras[0].X_BC().inverse() * rig.cameras[1].X_BC();
    renderer.draw({camera, X_WC, ImageChannel::grey}, left);
    renderer.draw({camera, X_WCr, ImageChannel::grey}, right);
    const Eigen::Vector2d shift_px = centroid(left) - centroid(right);
    worst_row_px = std::max(worst_row_px, std::abs(shift_px.y()));
    EXPECT_NEAR(shift_px.x(), camera.focal_x_px * pair.baseline_m / z_m, kPinholeRmsPx) << "trial " << trial;
  }
  RecordProperty("worst_row_px", std::to_string(worst_row_px));
  EXPECT_LT(worst_row_px, 0.02);
}

}  // namespace
}  // namespace hedgehop::sim
