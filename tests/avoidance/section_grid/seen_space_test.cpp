#include "avoidance/section_grid/seen_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance::section_grid {
namespace {

constexpr vision::stereo::StereoGeometry kGeometry{100.0, 79.5, 59.5, 0.3};
constexpr int kImageColsPx = 160, kImageRowsPx = 120;
constexpr int64_t kSecondNs = 1'000'000'000;
constexpr double kHalfHeight = 0.595;  // tangent of the angle between the axis and the upper or lower edge

/// A level camera that looks north.
Eigen::Isometry3d at(const Eigen::Vector3d& p_WC) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  X_WC.translation() = p_WC;
  return X_WC;
}

/// Everything is at one depth; 0: sky.
vision::stereo::DepthPyramid all_at(double z_m) {
  const double disparity16 = z_m > 0.0 ? kGeometry.disparity16(z_m) : 0.0;
  vision::stereo::DepthPyramid pyramid;
  pyramid.build(cv::Mat(kImageRowsPx, kImageColsPx, CV_16SC1, cv::Scalar::all(std::lround(disparity16))),
                SeenSpace::kBlockLevel);
  return pyramid;
}

// A camera at 8 m altitude in front of a wall at 10 m: free is the pyramid of its view in front of the wall.
TEST(SeenSpace, FreeIsTheViewInFrontOfTheWall) {
  SeenSpace seen;
  seen.update(0, all_at(10.0), kGeometry, at({0.0, 0.0, -8.0}));
  int free = 0;
  for (double north_m = 0.5; north_m < 14.0; north_m += 0.37) {
    for (double down_m = -6.0; down_m < 6.0; down_m += 0.37) {
      const double edge = std::abs(std::abs(down_m) / north_m - kHalfHeight);
      // Half a pixel of disparity is 1.4 m at 10 m.
      if (edge < 0.02 || (north_m > 8.4 && north_m < 10.0)) continue;
      const bool in_front = std::abs(down_m) / north_m < kHalfHeight && north_m < 9.0;
      EXPECT_EQ(seen.free({north_m, 0.0, -8.0 + down_m}), in_front) << north_m << " " << down_m;
      free += in_front;
    }
  }
  EXPECT_GT(free, 50);
}

TEST(SeenSpace, SpaceBelowTheVehicleIsFreeOnlyIfAnEarlierImageHadItInView) {
  const Eigen::Vector3d below_W(0.0, 0.0, -5.0);  // 3 m below the vehicle at its last position
  SeenSpace seen;
  seen.update(0, all_at(0.0), kGeometry, at({0.0, 0.0, -8.0}));
  EXPECT_FALSE(seen.free(below_W));
  seen.reset();
  seen.update(0, all_at(0.0), kGeometry, at({-6.0, 0.0, -8.0}));
  seen.update(kSecondNs, all_at(0.0), kGeometry, at({0.0, 0.0, -8.0}));
  EXPECT_TRUE(seen.free(below_W));
  seen.update(20 * kSecondNs, all_at(0.0), kGeometry, at({0.0, 0.0, -8.0}));
  EXPECT_FALSE(seen.free(below_W)) << "the first image is too old";
}

TEST(SeenSpace, NewestImageOfAPointDecides) {
  const Eigen::Vector3d p_W(6.0, 0.0, -8.0);
  for (const bool free_at_last : {true, false}) {
    SeenSpace seen;
    seen.update(0, all_at(free_at_last ? 3.0 : 0.0), kGeometry, at({0.0, 0.0, -8.0}));
    seen.update(kSecondNs, all_at(free_at_last ? 0.0 : 3.0), kGeometry, at({0.0, 0.0, -8.0}));
    EXPECT_EQ(seen.free(p_W), free_at_last);
  }
}

// The obstacle is a block of pixels at 6 m, 1 m to the right of the axis.
TEST(SeenSpace, PathIsFreeIfItKeepsTheRadiusFromAnObstacle) {
  cv::Mat disparity16(kImageRowsPx, kImageColsPx, CV_16SC1, cv::Scalar::all(0));
  disparity16(cv::Rect(96, 56, 8, 8)).setTo(std::lround(kGeometry.disparity16(6.0)));
  vision::stereo::DepthPyramid pyramid;
  pyramid.build(disparity16, SeenSpace::kBlockLevel);
  SeenSpace seen;
  for (int i = 0; i < 8; ++i) {  // the way in, which has the space around the start in view
    seen.update(i * kSecondNs, all_at(0.0), kGeometry, at({-8.0 + i, 0.0, -8.0}));
  }
  seen.update(8 * kSecondNs, pyramid, kGeometry, at({0.0, 0.0, -8.0}));
  const Eigen::Vector3d from_W(0.0, 0.0, -8.0), to_W(8.0, 0.0, -8.0);
  EXPECT_TRUE(seen.free_path(from_W, to_W, 0.5));
  EXPECT_FALSE(seen.free_path(from_W, to_W, 1.2));
  EXPECT_TRUE(seen.free_path(from_W, {4.0, 0.0, -8.0}, 1.2)) << "it ends before the obstacle";
  EXPECT_FALSE(seen.free_path(from_W, {8.0, 1.3, -8.0}, 0.3)) << "it leads to the obstacle";
}

}  // namespace
}  // namespace hedgehop::avoidance::section_grid
