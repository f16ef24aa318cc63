#include "avoidance/stereo/disparity_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::stereo {
namespace {

using From = DisparitySource::From;
using Grey = DisparitySource::Grey;

Setup depth_rig(double left_aside_m = 0.0) {
  Setup setup = stereo_pair(16, 10.0);
  setup.cameras[0].X_BC.translation().y() = left_aside_m;
  setup.cameras[1] = level_camera("depth", 0.0, 16, 10.0);
  return setup;
}

TEST(DisparitySource, DepthCameraReplacesAPairWithItsBaseline) {
  DisparitySource source(From::camera, Grey::unused, {}, depth_rig());
  cv::Mat depth_m(16, 16, CV_32FC1, cv::Scalar(10.0));
  depth_m.at<float>(0, 0) = std::numeric_limits<float>::infinity();
  depth_m.at<float>(0, 1) = std::numeric_limits<float>::quiet_NaN();
  const std::vector<CameraFrame> frames = {{"depth", 1, depth_m}};
  ASSERT_TRUE(source.update(frames));
  const double focal_px = 8.0;  // of 16 px over 90 degrees
  EXPECT_NEAR(source.disparity16().at<int16_t>(5, 5), 16.0 * focal_px * 0.3 / 10.0, 0.5);
  EXPECT_EQ(source.disparity16().at<int16_t>(0, 0), 0);
  EXPECT_EQ(source.disparity16().at<int16_t>(0, 1), vision::stereo::kNoDisparity);
  EXPECT_FALSE(source.update(frames)) << "not new any more";
}

TEST(DisparitySource, GreyAndDepthMustHaveTheSameTimeAndPose) {
  DisparitySource source(From::camera, Grey::needed, {}, depth_rig());
  const cv::Mat depth_m(16, 16, CV_32FC1, cv::Scalar(10.0)), grey(16, 16, CV_8UC1, cv::Scalar(100));
  const std::vector<CameraFrame> apart = {{"left", 1, grey}, {"depth", 2, depth_m}};
  EXPECT_FALSE(source.update(apart));
  const std::vector<CameraFrame> together = {{"left", 2, grey}, {"depth", 2, depth_m}};
  EXPECT_TRUE(source.update(together));
  EXPECT_EQ(source.grey().at<uint8_t>(3, 3), 100);
  EXPECT_THROW(DisparitySource(From::camera, Grey::needed, {}, depth_rig(0.1)), std::invalid_argument);
}

/// A level wire 6 m ahead, as matched by a pair of 0.3 m.
struct WireMatches {
  double share = 0.0;        ///< of the pixels along the wire that have a disparity
  double median_px = 0.0;    ///< of these
  double expected_px = 0.0;  ///< focal length x baseline / depth
};

/// @param above  one camera above the other, both on their sides; otherwise side by side.
WireMatches match_wire(bool above) {
  constexpr int kSidePx = 160;
  constexpr double kDepthM = 6.0, kBaselineM = 0.3, kWirePx = 2.0, kNoise = 2.0;
  Setup setup = stereo_pair(kSidePx, 10.0);
  for (MountedCamera& camera : setup.cameras) {
    if (above) camera.X_BC.linear() << 0, 0, 1, 0, -1, 0, 1, 0, 0;  // rows point down, columns to the left
  }
  if (above) setup.cameras[1].X_BC.translation() = Eigen::Vector3d(0.0, 0.0, kBaselineM);
  const vision::camera::PinholeCamera lens = setup.cameras[0].model.pinhole();

  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::vector<cv::Mat> images;
  std::vector<double> middles_px;
  for (const MountedCamera& camera : setup.cameras) {
    const Eigen::Vector3d p_C = camera.X_BC.inverse() * Eigen::Vector3d(kDepthM, 0.0, 0.4);
    middles_px.push_back(above ? lens.center_u_px + lens.focal_x_px * p_C.x() / p_C.z()
                               : lens.center_v_px + lens.focal_y_px * p_C.y() / p_C.z());
    cv::Mat& image = images.emplace_back(kSidePx, kSidePx, CV_8UC1);
    for (int v = 0; v < kSidePx; ++v) {
      for (int u = 0; u < kSidePx; ++u) {
        const double off_px = std::abs((above ? u : v) - middles_px.back());
        const double covered = std::clamp(0.5 * kWirePx + 0.5 - off_px, 0.0, 1.0);
        image.at<uint8_t>(v, u) = static_cast<uint8_t>(std::lround(180.0 - 120.0 * covered + noise(random)));
      }
    }
  }
  vision::stereo::StereoMatcherConfig matcher;
  matcher.method = vision::stereo::StereoMatcherConfig::Method::block;
  matcher.disparities_px = 32;
  matcher.block_px = 11;
  DisparitySource source(From::stereo, Grey::unused, matcher, setup);
  const std::vector<CameraFrame> frames = {{"left", 1, images[0]}, {"right", 1, images[1]}};
  EXPECT_TRUE(source.update(frames));
  vision::stereo::remove_specks(source.disparity16(), 32, 150);

  const int line_px = static_cast<int>(std::lround(middles_px[0]));
  const cv::Mat along = above ? source.disparity16().col(line_px) : source.disparity16().row(line_px).t();
  std::vector<int> found16;
  for (int i = 0; i < kSidePx; ++i) {
    if (along.at<int16_t>(i, 0) >= 0) found16.push_back(along.at<int16_t>(i, 0));
  }
  WireMatches matches{static_cast<double>(found16.size()) / kSidePx, 0.0, lens.focal_x_px * kBaselineM / kDepthM};
  std::ranges::sort(found16);
  if (!found16.empty()) matches.median_px = found16[found16.size() / 2] / vision::stereo::kDisparityUnits;
  return matches;
}

TEST(DisparitySource, LevelWireIsMatchedByCamerasAboveEachOtherButNotSideBySide) {
  const WireMatches above = match_wire(true);
  EXPECT_GT(above.share, 0.8);
  constexpr double kSubpixelPx = 0.25;  // of a line as wide as two pixels
  EXPECT_NEAR(above.median_px, above.expected_px, kSubpixelPx);
  EXPECT_LT(match_wire(false).share, 0.1);
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo
