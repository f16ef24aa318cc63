#include "vision/corridor/approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/vision/corridor/corridor_world.h"

namespace hedgehop::vision::corridor {
namespace {

constexpr double kDtS = 0.1;
constexpr int kCornerRimPx = 7;

// Two images of a wall across the path, 0.1 s of flight apart.
struct Pair {
  camera::Camera camera = whole_fisheye(480, 480);
  CameraMotion motion{looking_down().linear(), looking_down().linear(), Eigen::Vector3d::Zero(), kDtS, 1.5};
  cv::Mat older, newer;

  Pair(double range_m, const Eigen::Vector3d& v_H, const WaveTexture& texture, double half_width_m = 1.25,
       double roll_rad = 0.0) {
    motion.traveled_H = kDtS * v_H;
    motion.R_HC2 = Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()) * motion.R_HC1;
    StraightCorridor corridor;
    corridor.left_m = corridor.right_m = half_width_m;
    corridor.end_m = range_m;
    const auto draw = [&](const Eigen::Vector3d& p_WC, const Eigen::Matrix3d& R_WC) {
      Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
      X_WC.linear() = R_WC;
      X_WC.translation() = p_WC;
      return draw_planes_through(camera, X_WC, corridor.planes(), texture);
    };
    const Eigen::Vector3d p_WC1(0, 0, -1.5);
    older = draw(p_WC1, motion.R_HC1);
    newer = draw(p_WC1 + motion.traveled_H, motion.R_HC2);
  }
  std::optional<ApproachRate> measure() const {
    return ApproachMeter({}, camera, looking_down(), {}, kCornerRimPx).measure(older, newer, motion);
  }
};

WaveTexture waves(double shortest_m, double longest_m) { return {11, shortest_m, longest_m, 40}; }

TEST(ApproachRate, IsSpeedOverDistanceOfAWallEvenWithCoarseTexture) {
  for (const auto& [shortest_m, longest_m] : {std::pair{0.05, 0.3}, {0.4, 1.2}}) {
    for (const double range_m : {0.4, 0.9}) {
      for (const double v_mps : {0.3, 0.8}) {
        const auto found = Pair(range_m, {v_mps, 0, 0}, waves(shortest_m, longest_m)).measure();
        ASSERT_TRUE(found) << range_m << ' ' << longest_m;
        EXPECT_NEAR(found->rate_per_s, v_mps / range_m, 0.1 * v_mps / range_m)
            << range_m << " m, " << v_mps << " m/s, waves to " << longest_m << " m";
      }
    }
  }
}

TEST(ApproachRate, HoldsForLateralMotionAndARollingVehicle) {
  const double range_m = 0.8;
  const Eigen::Vector3d v_H(0.6, 0.15, 0.0);
  // On an oblique path, the distance of the wall along the path is the range over the cosine.
  const auto found = Pair(range_m, v_H, waves(0.1, 0.6), 1.25, 0.05).measure();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rate_per_s, v_H.x() / range_m, 0.15 * v_H.x() / range_m);
}

TEST(ApproachRate, AnOpenCorridorIsFarEvenIfNarrow) {
  for (const double half_width_m : {0.875, 1.25, 2.0}) {
    const auto found = Pair(30.0, {0.8, 0, 0}, waves(0.1, 0.6), half_width_m).measure();
    ASSERT_TRUE(found);
    // At most the rate of the nearest wall or floor in the evaluated view, which is beyond every braking distance.
    constexpr double kDeg = std::numbers::pi / 180.0;
    const double wall_m = half_width_m / std::tan(20.0 * kDeg),
                 floor_m = 1.5 / std::tan(25.0 * kDeg) * std::cos(20.0 * kDeg);
    EXPECT_LT(found->rate_per_s, 0.8 / std::min(wall_m, floor_m)) << half_width_m;
  }
}

TEST(ApproachRate, IsUnknownForABlankWall) {
  const cv::Mat grey(480, 752, CV_8UC1, cv::Scalar(128));
  Pair pair(1.0, {0.8, 0, 0}, waves(0.1, 0.6));
  pair.older = pair.newer = grey;
  EXPECT_FALSE(pair.measure());
}

TEST(ApproachRate, RejectsInvalidConfigs) {
  for (const ApproachConfig& config : {ApproachConfig{.half_width_rad = 0.0}, ApproachConfig{.sigma_per_s = 0.0}}) {
    EXPECT_THROW(ApproachMeter(config, whole_fisheye(), looking_down(), {}, kCornerRimPx), std::invalid_argument);
  }
}

}  // namespace
}  // namespace hedgehop::vision::corridor
