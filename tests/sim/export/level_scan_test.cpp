#include "sim/export/level_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hedgehop::sim {
namespace {

constexpr double kMaxM = 60.0;
constexpr double kPixels = 0.02;  // share of the range that one pixel of the depth image covers here

vision::camera::PinholeCamera lens() {
  vision::camera::PinholeCamera camera;
  camera.width_px = 161;
  camera.height_px = 121;
  camera.focal_x_px = camera.focal_y_px = 100.0;
  camera.center_u_px = 80.0;
  camera.center_v_px = 60.0;
  return camera;
}

/// Returns the pose of a camera at the origin of E that looks north, pitched up and rolled.
Eigen::Isometry3d camera_pose(double pitch_rad, double roll_rad) {
  Eigen::Isometry3d X_EC = Eigen::Isometry3d::Identity();
  X_EC.linear().col(0) = Eigen::Vector3d::UnitX();   // right: east
  X_EC.linear().col(1) = -Eigen::Vector3d::UnitZ();  // down
  X_EC.linear().col(2) = Eigen::Vector3d::UnitY();   // forward: north
  X_EC.linear() = X_EC.linear() * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()) *
                  Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
  return X_EC;
}

/// Returns the depth image of a wall at 10 m north, by the intersection of each pixel's ray with the wall.
cv::Mat wall_depth(const Eigen::Isometry3d& X_EC) {
  const vision::camera::PinholeCamera camera = lens();
  cv::Mat depth(camera.height_px, camera.width_px, CV_32FC1);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const Eigen::Vector3d ray_C((u - camera.center_u_px) / camera.focal_x_px,
                                  (v - camera.center_v_px) / camera.focal_y_px, 1.0);
      const Eigen::Vector3d ray_E = X_EC.linear() * ray_C;
      depth.at<float>(v, u) = ray_E.y() > 0.0 ? static_cast<float>(10.0 / ray_E.y()) : NAN;
    }
  }
  return depth;
}

TEST(LevelScan, MeasuresTheLevelDistanceToAWallWhateverTheTilt) {
  for (const auto& [pitch_rad, roll_rad] : {std::pair{0.0, 0.0}, {0.2, 0.0}, {-0.25, 0.15}}) {
    const Eigen::Isometry3d X_EC = camera_pose(pitch_rad, roll_rad);
    const auto scan = level_scan(wall_depth(X_EC), lens(), X_EC, kMaxM);
    ASSERT_TRUE(scan);
    int known = 0;
    for (size_t i = 0; i < scan->ranges_m.size(); ++i) {
      const double angle_rad = scan->angle_min_rad + static_cast<double>(i) * scan->angle_increment_rad;
      if (std::isnan(scan->ranges_m[i])) continue;
      ++known;
      EXPECT_NEAR(scan->ranges_m[i], 10.0 / std::cos(angle_rad), 10.0 * kPixels);
    }
    EXPECT_GT(known, 120);
  }
}

TEST(LevelScan, FrameIsLevelAndLooksAlongTheCamera) {
  const Eigen::Isometry3d X_EC = camera_pose(0.3, 0.2);
  const auto scan = level_scan(wall_depth(X_EC), lens(), X_EC, kMaxM);
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->X_ECl.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));   // north
  EXPECT_TRUE(scan->X_ECl.linear().col(1).isApprox(-Eigen::Vector3d::UnitX(), 1e-12));  // left: west
  EXPECT_TRUE(scan->X_ECl.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(LevelScan, AnglesCountToTheLeft) {
  const Eigen::Isometry3d X_EC = camera_pose(0.0, 0.0);
  cv::Mat depth(121, 161, CV_32FC1, cv::Scalar(20.0));
  depth.colRange(0, 40).setTo(5.0);  // an obstacle at the left
  const auto scan = level_scan(depth, lens(), X_EC, kMaxM);
  ASSERT_TRUE(scan);
  EXPECT_LT(scan->angle_min_rad, 0.0);
  EXPECT_LT(scan->ranges_m.back(), 8.0f);
  EXPECT_GT(scan->ranges_m.front(), 19.0f);
}

TEST(LevelScan, UnknownDepthIsNanAndSkyIsInfinite) {
  const Eigen::Isometry3d X_EC = camera_pose(0.0, 0.0);
  cv::Mat depth(121, 161, CV_32FC1, cv::Scalar(std::numeric_limits<float>::infinity()));
  depth.colRange(100, 161).setTo(std::nan(""));
  const auto scan = level_scan(depth, lens(), X_EC, kMaxM);
  ASSERT_TRUE(scan);
  EXPECT_TRUE(std::isnan(scan->ranges_m.front()));
  EXPECT_TRUE(std::isinf(scan->ranges_m.back()));
}

TEST(LevelScan, CameraThatLooksDownHasNone) {
  const Eigen::Isometry3d X_EC = camera_pose(-std::numbers::pi / 2.0, 0.0);
  EXPECT_FALSE(level_scan(wall_depth(X_EC), lens(), X_EC, kMaxM));
}

}  // namespace
}  // namespace hedgehop::sim
