#include "avoidance/stereo/motion_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/vision/motion/cast_world.h"

namespace hedgehop::avoidance::stereo {
namespace {

using vision::motion::CastWorld;
using vision::motion::InverseDepth;

constexpr vision::camera::PinholeCamera kLens{160, 90, 87.5, 87.5, 79.5, 44.5};
constexpr double kPeriodS = 0.1;

/// A camera at B's origin that looks ahead, in a world without noise.
struct Flight {
  CastWorld world;
  MountedCamera camera{"front", vision::camera::Camera(kLens), CastWorld::looking_north(Eigen::Vector3d::Zero()), 10.0};
  MotionDepth depth{camera};
  std::mt19937_64 generator{1};
  NavigationState navigation;
  CastWorld::Image image;
  double t_s = 0.0;

  /// Flies north for a period. @param yaw_rad  turn in it.
  InverseDepth fly(double speed_mps, double yaw_rad = 0.0) {
    t_s += kPeriodS;
    navigation.p_WB_est.x() += kPeriodS * speed_mps;
    navigation.q_WB_est = navigation.q_WB_est * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
    navigation.q_WB_gyro = navigation.q_WB_est;
    navigation.v_WB_B_est = navigation.q_WB_est.conjugate() * Eigen::Vector3d(speed_mps, 0.0, 0.0);
    image = world.image(kLens, CastWorld::looking_north(navigation.p_WB_est, navigation.q_WB_est), 0.0, generator);
    return depth.update(image.grey, navigation, t_s);
  }
};

int matched(const InverseDepth& depth) { return cv::countNonZero(depth.per_m == depth.per_m); }

TEST(MotionDepth, HasNoDepthWithoutMotion) {
  Flight flight;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(matched(flight.fly(0.0, 0.02)), 0);
  EXPECT_EQ(flight.depth.baseline_m(), 0.0);
}

TEST(MotionDepth, BaselineFollowsTheDistanceOfTheNearestSurface) {
  Flight flight;
  flight.world.box = Eigen::AlignedBox3d(Eigen::Vector3d(-6.0, 0.4, -0.8), Eigen::Vector3d(-5.0, 1.6, 1.5));  // behind
  for (int i = 0; i < 20; ++i) flight.fly(2.0);  // the ground is the nearest surface in view, at 3 m
  const double far_m = flight.depth.baseline_m();
  for (int i = 0; i < 18; ++i) flight.fly(2.0);  // the wall, at 1.4 m
  EXPECT_GT(far_m, 0.5);
  EXPECT_LT(flight.depth.baseline_m(), 0.8 * far_m);
}

// Neither a jump of the estimated position nor a correction of the attitude is a motion.
TEST(MotionDepth, FollowsVelocityAndGyrosOnly) {
  constexpr double kOutliers = 0.1;
  Flight flight;
  for (int i = 0; i < 8; ++i) flight.fly(1.5, 0.01);
  flight.fly(1.5);
  NavigationState corrected = flight.navigation;
  corrected.p_WB_est += Eigen::Vector3d(0.5, -0.5, 0.3);
  corrected.q_WB_est = corrected.q_WB_est * Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY());
  corrected.v_WB_B_est.setZero();  // a second image at the same place
  const InverseDepth depth = flight.depth.update(flight.image.grey, corrected, flight.t_s + 1e-6);
  ASSERT_GT(matched(depth), 500);
  int right = 0;
  for (int v = 0; v < depth.per_m.rows; ++v) {
    for (int u = 0; u < depth.per_m.cols; ++u) {
      const double error = depth.per_m.at<float>(v, u) - flight.image.per_m.at<float>(2 * v, 2 * u);
      right += std::abs(error) < 4.0 * depth.sigma_per_m.at<float>(v, u);
    }
  }
  EXPECT_GT(right, (1.0 - kOutliers) * matched(depth));
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo
