#include "avoidance/landmark_map/map_overlay.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::landmark_map {
namespace {

using Eigen::Vector2d;

/// Center of all yellow pixels: the vehicle, if there is no planned path.
Vector2d vehicle_px(const Vector2d& at_NE) {
  PlanView view;
  view.from_NE = {-90, 0};
  view.to_NE = {100, 0};
  view.at_NE = at_NE;
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(0));
  draw_plan(view, image);
  Vector2d sum = Vector2d::Zero();
  int count = 0;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto rgb = image.at<cv::Vec3b>(v, u);
      if (rgb[0] < 200 || rgb[1] < 180 || rgb[2] > 120) continue;
      sum += Vector2d(u, v);
      ++count;
    }
  }
  EXPECT_GT(count, 5);
  return sum / count;
}

TEST(PlanImage, NorthIsUpAndEastIsRightWithOneScale) {
  const Vector2d middle = vehicle_px({5, 0}), north = vehicle_px({65, 0}), east = vehicle_px({5, 60});
  constexpr double kPixel = 1.0;
  EXPECT_NEAR(north.x(), middle.x(), kPixel);
  EXPECT_NEAR(east.y(), middle.y(), kPixel);
  EXPECT_GT(middle.y() - north.y(), 20.0);
  EXPECT_NEAR(middle.y() - north.y(), east.x() - middle.x(), kPixel);
}

TEST(PlanImage, DoesNotChangeASmallImage) {
  cv::Mat image(160, 160, CV_8UC3, cv::Scalar::all(77));
  const cv::Mat before = image.clone();
  draw_plan({}, image);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::landmark_map
