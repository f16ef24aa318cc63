#include "vision/stereo/flight_corridor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/vision/stereo/random_disparity.h"

namespace hedgehop::vision::stereo {
namespace {

using State = Corridor::State;

/// The definition as printed, pixel by pixel: [Andert2007] eq. (3), (9) to (11).
Corridor by_definition(const cv::Mat& d16, const StereoGeometry& g, const cv::Point& path, double r, double target_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  bool seen = false;
  const double a_x = std::hypot(g.focal_px, path.x - g.center_u_px) * r / g.focal_px;
  const double a_y = std::hypot(g.focal_px, path.y - g.center_v_px) * r / g.focal_px;
  for (int y = 0; y < d16.rows; ++y) {
    for (int x = 0; x < d16.cols; ++x) {
      const int d = d16.at<int16_t>(y, x);
      if (d < 0) continue;
      if (d == 0) {  // infinitely far: inside only on the ray itself
        seen |= x == path.x && y == path.y;
        continue;
      }
      const double z = g.baseline_m * g.focal_px / (d / 16.0);
      const double dx = z * (x - path.x) / g.focal_px, dy = z * (y - path.y) / g.focal_px;
      if (dx * dx / (a_x * a_x) + dy * dy / (a_y * a_y) > 1.0) continue;
      seen = true;
      nearest_m = std::min(nearest_m, z);
    }
  }
  if (!seen) return {};
  return {nearest_m <= target_m ? State::blocked : State::free, nearest_m, 0};
}

TEST(FlightCorridor, PyramidAgreesWithTheDefinitionOnRandomImages) {
  std::mt19937_64 random(5);
  std::array<int, 3> states{};
  for (int trial = 0; trial < 1200; ++trial) {
    const cv::Size size(64 + trial % 33, 48 + trial % 17);
    const StereoGeometry geometry{51.2, 0.5 * (size.width - 1), 0.5 * (size.height - 1), 3.0};
    const cv::Mat d = random_disparity(random, size, trial);
    DepthPyramid pyramid;
    pyramid.build(d, trial % 6);
    const cv::Point path(static_cast<int>(random() % static_cast<uint64_t>(size.width)),
                         static_cast<int>(random() % static_cast<uint64_t>(size.height)));
    const double radius_m = 0.5 + 0.01 * (trial % 400), target_m = 10.0 + trial % 30;
    const Corridor expected = by_definition(d, geometry, path, radius_m, target_m);
    const Corridor nearest = examine_corridor(pyramid, geometry, path, radius_m, 0.0);
    const Corridor found = examine_corridor(pyramid, geometry, path, radius_m, target_m);
    ASSERT_EQ(found.state, expected.state) << trial;
    ++states[static_cast<size_t>(found.state)];
    if (expected.state == State::unknown) continue;
    const double kRounding = 1e-12;
    if (std::isinf(expected.z_m)) {
      ASSERT_EQ(nearest.z_m, expected.z_m) << trial;
    } else {
      ASSERT_NEAR(nearest.z_m / expected.z_m, 1.0, kRounding) << trial;
    }
    if (found.state == State::free) {
      ASSERT_EQ(found.z_m, nearest.z_m) << trial;
    } else {
      ASSERT_LE(found.z_m, target_m) << trial;
    }
  }
  for (const int count : states) EXPECT_GE(count, 50);  // the images are of every kind
}

TEST(FlightCorridor, ResultDoesNotDependOnThePyramidsHeight) {
  std::mt19937_64 random(6);
  const StereoGeometry geometry{128.0, 79.5, 59.5, 0.3};
  for (int trial = 0; trial < 50; ++trial) {
    const cv::Mat d = random_disparity(random, {160, 120}, trial);
    DepthPyramid flat, high;
    flat.build(d, 0);
    high.build(d, 6);
    const cv::Point path(40 + trial, 60);
    const Corridor a = examine_corridor(flat, geometry, path, 2.0, 0.0);
    const Corridor b = examine_corridor(high, geometry, path, 2.0, 0.0);
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.z_m, b.z_m);
  }
}

// The cylinder intersects a wall at distance z in an ellipse. Posts just inside and just outside its border are tested.
TEST(FlightCorridor, PostNextToTheRayBlocksOnlyWithinTheRadius) {
  const StereoGeometry geometry{512.0, 319.5, 239.5, 0.3};
  const int d16 = 123;
  const double z_m = geometry.z_m(d16), radius_m = 2.0;
  const int reach_px = static_cast<int>(radius_m * geometry.focal_px / z_m);
  for (const bool within : {true, false}) {
    cv::Mat d(480, 640, CV_16SC1, cv::Scalar(0));
    d.at<int16_t>(240, 320 + reach_px + (within ? 0 : 1)) = d16;
    DepthPyramid pyramid;
    pyramid.build(d, 5);
    const Corridor found = examine_corridor(pyramid, geometry, {320, 240}, radius_m, 30.0);
    EXPECT_EQ(found.state, within ? State::blocked : State::free);
  }
}

// [Andert2007] sec. 4.2: purpose of the pyramid.
TEST(FlightCorridor, ThePyramidTestsAHundredthOfThePoints) {
  const StereoGeometry geometry{512.0, 319.5, 239.5, 0.3};
  cv::Mat d(480, 640, CV_16SC1);
  for (int v = 0; v < d.rows; ++v) d.row(v).setTo(v < 240 ? 45 : 45 + (v - 240) / 2);  // ground and far trees
  d(cv::Rect(400, 150, 80, 160)).setTo(120);
  DepthPyramid pyramid;
  pyramid.build(d, 6);
  const Corridor found = examine_corridor(pyramid, geometry, {250, 200}, 2.0, 0.0);
  EXPECT_EQ(found.state, State::free);
  EXPECT_GT(found.tests, 0);
  EXPECT_LE(100 * found.tests, 640 * 480);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
