#include "avoidance/stereo/disparity_source.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

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

}  // namespace
}  // namespace hedgehop::avoidance::stereo
