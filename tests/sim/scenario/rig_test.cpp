#include "sim/scenario/rig.h"

#include <gtest/gtest.h>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

constexpr double kRoundOff = 1e-15;

/// Forward (z), right (x) and down (y) axes of a mounted camera, in B.
void expect_axes(const CameraConfig& camera, const Eigen::Vector3d& forward, const Eigen::Vector3d& right) {
  const Eigen::Matrix3d R_BC = camera.X_BC().linear();
  EXPECT_LT((R_BC.col(2) - forward).norm(), kRoundOff);
  EXPECT_LT((R_BC.col(0) - right).norm(), kRoundOff);
  EXPECT_LT((R_BC.col(1) - forward.cross(right)).norm(), kRoundOff);
}

CameraConfig mounted(double yaw_deg, double pitch_deg, double roll_deg) {
  CameraConfig camera;
  camera.yaw_rad = yaw_deg * kRadPerDeg;
  camera.pitch_rad = pitch_deg * kRadPerDeg;
  camera.roll_rad = roll_deg * kRadPerDeg;
  return camera;
}

TEST(Rig, MountsCamerasInTheDirectionsTheirAnglesSay) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  expect_axes(mounted(0, 0, 0), x, y);
  expect_axes(mounted(90, 0, 0), y, -x);    // looks right
  expect_axes(mounted(-90, 0, 0), -y, x);   // looks left
  expect_axes(mounted(180, 0, 0), -x, -y);  // looks aft
  expect_axes(mounted(0, -90, 0), z, y);    // looks down, its top towards the nose
  expect_axes(mounted(0, 90, 0), -z, y);    // looks up
  expect_axes(mounted(0, 0, 90), x, z);     // rolled clockwise: its right points down
  expect_axes(mounted(90, -90, 0), z, -x);  // yaw first, then pitch about the camera's own right
}

TEST(Rig, PlacesCamerasAtTheirMountingPosition) {
  CameraConfig camera;
  camera.forward_m = 1.0;
  camera.right_m = 2.0;
  camera.down_m = 3.0;
  EXPECT_EQ(Eigen::Vector3d(camera.X_BC().translation()), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(Rig, ModelHasTheFieldOfView) {
  CameraConfig camera;  // 400 px across 90 deg
  EXPECT_NEAR(camera.model().pinhole().focal_x_px, 200.0, 1e-12);
}

TEST(Rig, FindsCamerasByRole) {
  RigConfig rig;
  rig.cameras.resize(2);
  rig.cameras[1].role = "down";
  EXPECT_EQ(rig.find("down"), &rig.cameras[1]);
  EXPECT_EQ(rig.find("up"), nullptr);
}

}  // namespace
}  // namespace hedgehop::sim
