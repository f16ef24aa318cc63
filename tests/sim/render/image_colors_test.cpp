#include "sim/render/image_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hedgehop::sim {
namespace {

cv::Vec3b depth_color(float depth_m) {
  return colored_depth(cv::Mat(1, 1, CV_32FC1, cv::Scalar(depth_m))).at<cv::Vec3b>(0);
}
cv::Vec3b flow_color(float right_px, float down_px) {
  return colored_flow(cv::Mat(1, 1, CV_32FC2, cv::Scalar(right_px, down_px))).at<cv::Vec3b>(0);
}

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();

TEST(ImageColors, DepthIsRedThenGreenThenBlue) {
  const cv::Vec3b near = depth_color(0.7f), middle = depth_color(10.0f), far = depth_color(120.0f);
  EXPECT_TRUE(near[0] > near[1] && near[0] > near[2]);
  EXPECT_TRUE(middle[1] > middle[0] && middle[1] > middle[2]);
  EXPECT_TRUE(far[2] > far[0] && far[2] > far[1]);
  EXPECT_EQ(depth_color(0.1f), depth_color(0.5f));
  EXPECT_EQ(depth_color(200.0f), depth_color(5000.0f));
  EXPECT_EQ(depth_color(kInfinity), cv::Vec3b::all(255));
  EXPECT_EQ(depth_color(kNan), cv::Vec3b::all(0));
}

TEST(ImageColors, FlowHasHueOfDirectionAndSaturationOfMagnitude) {
  EXPECT_EQ(flow_color(0, 0), cv::Vec3b::all(255));
  EXPECT_EQ(flow_color(16, 0), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(flow_color(90, 0), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(flow_color(-16, 0), cv::Vec3b(0, 255, 255));
  EXPECT_GT(flow_color(0, 16)[1], flow_color(0, 16)[2]);
  EXPECT_GT(flow_color(0, -16)[2], flow_color(0, -16)[1]);
  EXPECT_EQ(flow_color(8, 0)[0], 255);
  EXPECT_NEAR(flow_color(8, 0)[1], 127, 1);
  EXPECT_EQ(flow_color(kNan, kNan), cv::Vec3b::all(0));
}

TEST(ImageColors, NeighboringLabelsDiffer) {
  cv::Mat labels(1, 200, CV_32SC1);
  for (int i = 0; i < labels.cols; ++i) labels.at<int>(i) = i;
  const cv::Mat colors = colored_labels(labels);
  EXPECT_EQ(colors.at<cv::Vec3b>(0), cv::Vec3b::all(0));
  for (int i = 0; i < labels.cols; ++i) {
    for (int j = i + 1; j < std::min(i + 40, labels.cols); ++j) {
      ASSERT_NE(colors.at<cv::Vec3b>(i), colors.at<cv::Vec3b>(j)) << i << ", " << j;
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
