#include "avoidance/stereo_corridor/stopping_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

using Eigen::Vector3d;

constexpr double kAccelerationMps2 = 2.0, kHullM = 0.7, kReactionS = 1.0;

/// A view of 64 x 64 px, 90 degrees, of a wall in front of the sky in the rows above `below_px`.
double speed_mps(int below_px, double wall_m, const Vector3d& v_WB_C) {
  constexpr int kImagePx = 64;
  const vision::stereo::StereoGeometry geometry{
      .focal_px = 32.0, .center_u_px = 31.5, .center_v_px = 31.5, .baseline_m = 0.5};
  cv::Mat disparity16(kImagePx, kImagePx, CV_16SC1, cv::Scalar(0));
  if (below_px > 0) disparity16.rowRange(0, below_px).setTo(geometry.disparity16(wall_m));
  vision::stereo::DepthPyramid pyramid;
  pyramid.build(disparity16, CorridorSearch::kCoarsestLevel);
  return stopping_speed_mps(pyramid, geometry, /*radius_m=*/1.0, v_WB_C, kAccelerationMps2, kHullM);
}

TEST(StoppingSpeed, ReactionAndBrakingEndAtTheObstacle) {
  constexpr double kDisparityStep = 0.03;  // of 16ths of a pixel at 16 m
  for (const double wall_m : {4.0, 8.0, 16.0}) {
    const double speed = speed_mps(64, wall_m, {0.0, 0.0, 5.0});
    const double path_m = speed * kReactionS + speed * speed / (2.0 * kAccelerationMps2);
    EXPECT_NEAR(path_m, wall_m - kHullM, kDisparityStep * wall_m) << wall_m;
  }
}

TEST(StoppingSpeed, CountsObstaclesInTheDirectionOfFlightOnly) {
  const Vector3d down(0.0, 3.0, 5.0), up(0.0, -3.0, 5.0);
  EXPECT_TRUE(std::isinf(speed_mps(32, 8.0, down)));
  EXPECT_LT(speed_mps(32, 8.0, up), 5.0);
}

TEST(StoppingSpeed, CountsTheNearestSeenSpaceForADirectionOutsideTheImage) {
  const Vector3d steeply_up(0.0, -3.0, 1.0), steeply_down(0.0, 3.0, 1.0);
  EXPECT_LT(speed_mps(32, 8.0, steeply_up), 5.0);
  EXPECT_TRUE(std::isinf(speed_mps(32, 8.0, steeply_down)));
}

TEST(StoppingSpeed, IsUnlimitedInAHoverAndLowestBackwards) {
  EXPECT_TRUE(std::isinf(speed_mps(64, 2.0, {0.0, 0.0, 0.1})));
  EXPECT_EQ(speed_mps(0, 2.0, {0.0, 0.0, -3.0}), 0.5);
}

TEST(StoppingSpeed, KeepsADirectionOfFlight) { EXPECT_EQ(speed_mps(64, 0.5, {0.0, 0.0, 1.0}), 0.5); }

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
