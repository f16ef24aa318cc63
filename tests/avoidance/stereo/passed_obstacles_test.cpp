#include "avoidance/stereo/passed_obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace hedgehop::avoidance::stereo {
namespace {

constexpr int kWidthPx = 160, kHeightPx = 120;
constexpr vision::stereo::StereoGeometry kGeometry{128.0, 79.5, 59.5, 0.3};
constexpr int64_t kSecondNs = 1'000'000'000;

/// A camera at B's origin that looks along `heading_rad`, level.
Eigen::Isometry3d looking(double heading_rad, const Eigen::Vector3d& p_WC = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  X_WC.linear() << -s, 0.0, c, c, 0.0, s, 0.0, 1.0, 0.0;
  X_WC.translation() = p_WC;
  return X_WC;
}

/// Depth image with one block of pixels at `z_m` in front of the sky.
vision::stereo::DepthPyramid block_at(const cv::Rect& pixels, double z_m) {
  cv::Mat disparity16(kHeightPx, kWidthPx, CV_16SC1, cv::Scalar(0));
  disparity16(pixels).setTo(std::lround(kGeometry.disparity16(z_m)));
  vision::stereo::DepthPyramid pyramid;
  pyramid.build(disparity16, 4);
  return pyramid;
}
const vision::stereo::DepthPyramid kSky = block_at({}, 1.0);

Eigen::Vector3d towards(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad), 0.0}; }

TEST(PassedObstacles, ObstacleOutOfViewBlocksThePathsWithinTheRadius) {
  PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
  // A block of one pyramid pixel at a known position: 6 m ahead, at the right edge of the image.
  const cv::Rect block(152, 56, 8, 8);
  passed.update(0, block_at(block, 6.0), kGeometry, looking(0.0));
  EXPECT_TRUE(passed.points_W().empty());  // still in view
  passed.update(kSecondNs / 10, kSky, kGeometry, looking(-0.3));
  ASSERT_EQ(passed.points_W().size(), 1u);
  const Eigen::Vector3d p = passed.points_W().front();
  EXPECT_NEAR(p.x(), 6.0, 0.05);
  EXPECT_NEAR(p.y(), 6.0 * (156 - 79.5) / 128.0, 0.05);
  for (double heading_rad = -M_PI; heading_rad < M_PI; heading_rad += 0.01) {
    const double off_rad = heading_rad - std::atan2(p.y(), p.x());
    const bool passes_within = std::cos(off_rad) > 0.0 && std::abs(p.norm() * std::sin(off_rad)) < 1.5;
    if (std::abs(std::abs(p.norm() * std::sin(off_rad)) - 1.5) < 0.02) continue;  // the block's height: 0.02 m
    EXPECT_EQ(passed.free(towards(heading_rad)), !passes_within) << heading_rad;
  }
}

TEST(PassedObstacles, NearestIsInViewOrRemembered) {
  PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
  EXPECT_TRUE(std::isinf(passed.nearest_m()));
  passed.update(0, block_at({152, 56, 8, 8}, 6.0), kGeometry, looking(0.0));
  const double range_m = 6.0 * std::hypot(1.0, (156 - 79.5) / 128.0);
  EXPECT_NEAR(passed.nearest_m(), range_m, 0.05);
  passed.update(kSecondNs / 10, kSky, kGeometry, looking(-0.3, {0.0, -1.0, 0.0}));
  EXPECT_NEAR(passed.nearest_m(), std::hypot(6.0, 6.0 * (156 - 79.5) / 128.0 + 1.0), 0.05);
}

TEST(PassedObstacles, PathThatEndsInFrontOfAnObstacleIsFree) {
  PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
  passed.update(0, block_at({152, 56, 8, 8}, 6.0), kGeometry, looking(0.0));
  passed.update(kSecondNs / 10, kSky, kGeometry, looking(-0.3));
  ASSERT_EQ(passed.points_W().size(), 1u);
  const Eigen::Vector3d p = passed.points_W().front();
  for (double off_rad = -0.4; off_rad < 0.4; off_rad += 0.05) {
    const Eigen::Vector3d ahead = towards(std::atan2(p.y(), p.x()) + off_rad);
    for (double reach_m = 0.1; reach_m < 10.0; reach_m += 0.1) {
      double nearest_m = p.norm();
      for (double along_m = 0.0; along_m <= reach_m; along_m += 0.01) {
        nearest_m = std::min(nearest_m, (along_m * ahead - p).norm());
      }
      if (std::abs(nearest_m - 1.5) < 0.02) continue;
      EXPECT_EQ(passed.free(ahead, reach_m), nearest_m > 1.5) << reach_m;
    }
  }
}

TEST(PassedObstacles, ObstacleInViewCountsOnlyIfAllAreTested) {
  constexpr double kAnyM = std::numeric_limits<double>::infinity();
  PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
  passed.update(0, block_at({76, 56, 8, 8}, 6.0), kGeometry, looking(0.0));
  EXPECT_TRUE(passed.free(towards(0.0)));
  EXPECT_FALSE(passed.free(towards(0.0), kAnyM, PassedObstacles::Among::all));
  EXPECT_TRUE(passed.free(towards(0.5), kAnyM, PassedObstacles::Among::all)) << "it passes at 2.9 m";
}

TEST(PassedObstacles, ObstacleThatTheLastImagesMissCountsForASecondIfAllAreTested) {
  constexpr double kAnyM = std::numeric_limits<double>::infinity();
  PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
  passed.update(0, block_at({76, 56, 8, 8}, 6.0), kGeometry, looking(0.0));
  for (const double t_s : {0.4, 0.9, 1.4}) {
    passed.update(static_cast<int64_t>(t_s * kSecondNs), kSky, kGeometry, looking(0.0));
    EXPECT_TRUE(passed.free(towards(0.0)));
    EXPECT_EQ(passed.free(towards(0.0), kAnyM, PassedObstacles::Among::all), t_s > 1.0) << t_s;
  }
}

TEST(PassedObstacles, ObstacleBehindTheCameraCountsUntilItIsFartherThanTheRadius) {
  constexpr double kAnyM = std::numeric_limits<double>::infinity();
  for (const double past_m : {1.0, 2.0}) {
    PassedObstacles passed({.radius_m = 1.5, .near_m = 12.0, .keep_s = 8.0});
    passed.update(0, block_at({72, 56, 8, 8}, 6.0), kGeometry, looking(0.0));
    passed.update(kSecondNs, kSky, kGeometry, looking(0.0, {6.0 + past_m, 0.0, 0.0}));
    ASSERT_EQ(passed.points_W().size(), 1u);
    EXPECT_TRUE(passed.free(towards(0.0)));
    EXPECT_EQ(passed.free(towards(0.0), kAnyM, PassedObstacles::Among::all), past_m > 1.5);
  }
}

TEST(PassedObstacles, PointThatIsInViewAgainIsDeleted) {
  PassedObstacles passed({});
  passed.update(0, block_at({140, 50, 16, 16}, 6.0), kGeometry, looking(0.0));
  passed.update(kSecondNs, kSky, kGeometry, looking(-0.8));
  EXPECT_FALSE(passed.free(towards(0.45)));
  passed.update(2 * kSecondNs, kSky, kGeometry, looking(0.4));
  EXPECT_TRUE(passed.free(towards(0.45)));
  EXPECT_TRUE(passed.points_W().empty());
}

TEST(PassedObstacles, DeletesOldAndDistantPoints) {
  for (const bool by_age : {false, true}) {
    PassedObstacles passed({.radius_m = 2.0, .near_m = 12.0, .keep_s = 5.0});
    passed.update(0, block_at({140, 50, 16, 16}, 6.0), kGeometry, looking(0.0));
    passed.update(4 * kSecondNs, kSky, kGeometry, looking(-0.8));
    EXPECT_FALSE(passed.points_W().empty());
    const Eigen::Vector3d far_away(-8.0, 0.0, 0.0);
    if (by_age) {
      passed.update(6 * kSecondNs, kSky, kGeometry, looking(-0.8));
    } else {
      passed.update(4 * kSecondNs + 1, kSky, kGeometry, looking(-0.8, far_away));
    }
    EXPECT_TRUE(passed.points_W().empty());
  }
}

TEST(PassedObstacles, NoFreePathComesNearerThanTheRadiusOrATenthNearerThanBefore) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr double kRadiusM = 2.0;
  int blocked = 0, open = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    PassedObstacles passed({.radius_m = kRadiusM, .near_m = 12.0, .keep_s = 5.0});
    const cv::Rect block(8 * (trial % 20), 8 * (trial % 15), 8, 8);
    passed.update(0, block_at(block, 4.0 + 3.0 * uniform(random)), kGeometry, looking(0.0));
    const Eigen::Vector3d moved(2.0 * uniform(random), uniform(random), uniform(random));
    passed.update(1, kSky, kGeometry, looking(M_PI, moved));
    const Eigen::Vector3d direction(uniform(random), uniform(random), uniform(random));
    double worst_m = std::numeric_limits<double>::infinity();  // remaining clearance along the path
    for (const Eigen::Vector3d& p : passed.points_W()) {
      const double allowed_m = std::min(kRadiusM, 0.9 * (p - moved).norm());
      for (double s_m = 0.0; s_m < 20.0; s_m += 0.01) {
        worst_m = std::min(worst_m, (moved + s_m * direction.normalized() - p).norm() - allowed_m);
      }
    }
    if (std::abs(worst_m) < 1e-4) continue;  // steps of 1 cm resolve the nearest distance to 0.05 mm at 0.5 m
    (worst_m > 0.0 ? open : blocked) += 1;
    EXPECT_EQ(passed.free(direction), worst_m > 0.0) << trial;
  }
  EXPECT_GT(blocked, 30);
  EXPECT_GT(open, 100);
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo
