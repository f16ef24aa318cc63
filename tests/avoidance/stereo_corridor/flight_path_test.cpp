#include "avoidance/stereo_corridor/flight_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

using Eigen::Vector3d;

constexpr double kLookAheadM = CorridorSearch::kLookAheadM;

TEST(FlightPath, LiesAheadOfThePointNearestToTheVehicle) {
  FlightPath path;
  EXPECT_TRUE(path.ahead_W({-70.0, 0.0, -6.0}, {60.0, 0.0, -6.0}).isApprox(Vector3d(-70.0 + kLookAheadM, 0.0, -6.0)));
  // Eight meters from the path and three above it.
  EXPECT_TRUE(path.ahead_W({0.0, 8.0, -9.0}, {60.0, 0.0, -6.0}).isApprox(Vector3d(kLookAheadM, 0.0, -6.0)));
}

TEST(FlightPath, ChangesItsAltitudeEvenlyAndContinuesBeyondTheGoal) {
  FlightPath path;
  path.ahead_W({0.0, 0.0, -4.0}, {100.0, 0.0, -14.0});
  EXPECT_TRUE(path.ahead_W({20.0, 0.0, -6.0}, {100.0, 0.0, -14.0})
                  .isApprox(Vector3d(20.0 + kLookAheadM, 0.0, -4.0 - 0.1 * (20.0 + kLookAheadM))));
  EXPECT_TRUE(path.ahead_W({95.0, 0.0, -6.0}, {100.0, 0.0, -14.0}).isApprox(Vector3d(95.0 + kLookAheadM, 0.0, -14.0)));
}

TEST(FlightPath, OfARouteBeginsAtTheLastWaypoint) {
  FlightPath path;
  path.ahead_W({0.0, 0.0, -6.0}, {50.0, 0.0, -6.0});
  const Vector3d beside(48.0, 5.0, -6.0);  // of the waypoint when it counts as passed
  EXPECT_TRUE(path.ahead_W(beside, {50.0, 100.0, -6.0}).isApprox(Vector3d(50.0, 5.0 + kLookAheadM, -6.0)));
}

/// A view of 64 x 64 px, 90 degrees, of an object 10 m away in some columns in front of the sky.
class View {
 public:
  View(int from_px, int to_px) {
    cv::Mat disparity16(kSizePx, kSizePx, CV_16SC1, cv::Scalar(0));
    if (to_px > from_px) disparity16.colRange(from_px, to_px).setTo(geometry_.disparity16(10.0));
    pyramid_.build(disparity16, CorridorSearch::kCoarsestLevel);
  }
  std::optional<Target> keep(const Vector3d& path_C) const {
    CorridorSearch search(pyramid_, geometry_, {.radius_m = 1.0, .target_m = 20.0});
    return keep_path(search, path_C, std::nullopt);
  }

 private:
  static constexpr int kSizePx = 64;
  vision::stereo::StereoGeometry geometry_{
      .focal_px = 32.0, .center_u_px = 31.5, .center_v_px = 31.5, .baseline_m = 0.3};
  vision::stereo::DepthPyramid pyramid_;
};

constexpr int kMiddlePx = 32;
const Vector3d kPath(5.0, 0.0, 30.0);  // ahead to the right: at 36.8 px

TEST(KeepPath, FliesAlongAFreePath) {
  const auto target = View(0, 0).keep(kPath);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->found_by, FoundBy::keep);
  EXPECT_EQ(target->pixel, cv::Point(37, 32));
}

TEST(KeepPath, TakesTheCorridorNearestToABlockedPath) {
  const auto target = View(34, 64).keep(kPath);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->found_by, FoundBy::search);
  EXPECT_LT(target->pixel.x, 34 - 3);  // one meter at a distance of 10 m is 3.2 px
}

TEST(KeepPath, TurnsTowardsAPathOutsideTheView) {
  const auto target = View(0, 0).keep({30.0, 0.0, 5.0});
  ASSERT_TRUE(target);
  EXPECT_EQ(target->found_by, FoundBy::search);
  EXPECT_GT(target->pixel.x, kMiddlePx);
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
