#include "avoidance/stereo_corridor/target_overlay.h"

#include <gtest/gtest.h>

#include "tests/vision/stereo/random_disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

const cv::Size kImage(64, 48);
constexpr int kCaptionPx = 20;  // maximum number of rows of a caption

/// The six panels of an image, left to right, top to bottom.
cv::Mat panel(const cv::Mat& image, int i) {
  return image(cv::Rect({i % 3 * kImage.width, i / 3 * kImage.height}, kImage));
}

TEST(TargetImage, TintsEveryBlockToItsEdgeAndDangerousBlocksRed) {
  std::mt19937_64 random(3);
  constexpr int kTop = 4, kFinest = 2;
  constexpr double kFar16 = 150.0;
  for (int trial = 0; trial < 50; ++trial) {
    vision::stereo::DepthPyramid pyramid;
    pyramid.build(vision::random_disparity(random, kImage, trial), kTop);
    TargetImage seen;
    seen.grey = cv::Mat(kImage, CV_8UC1, cv::Scalar(100));
    seen.matched16 = cv::Mat(kImage, CV_16SC1, cv::Scalar(0));
    for (const cv::Point& block : vision::stereo::quadtree_targets(pyramid, kFar16, kTop, kFinest)) {
      seen.candidates.push_back({block, seen.candidates.size() % 2 == 0});
    }
    const cv::Mat drawn = panel(draw(seen, pyramid, {80.0, 31.5, 23.5, 0.3}, 60.0), 4);
    for (const TargetImage::Candidate& candidate : seen.candidates) {
      if (candidate.pixel.y < kCaptionPx) continue;
      const auto color = drawn.at<cv::Vec3b>(candidate.pixel);
      EXPECT_EQ(color[0] > color[1], !candidate.free) << trial;
    }
    // No block of any size with a near obstacle is tinted.
    const cv::Mat near_there = pyramid.level(kFinest) >= kFar16;
    for (int v = kCaptionPx; v < kImage.height; ++v) {
      for (int u = 0; u < kImage.width; ++u) {
        if (!near_there.at<uint8_t>(v >> kFinest, u >> kFinest)) continue;
        EXPECT_EQ(drawn.at<cv::Vec3b>(v, u), cv::Vec3b(100, 100, 100)) << trial << ": " << u << " " << v;
      }
    }
  }
}

TEST(TargetImage, CirclesTheChosenTarget) {
  vision::stereo::DepthPyramid pyramid;
  pyramid.build(cv::Mat(kImage, CV_16SC1, cv::Scalar(0)), 2);
  TargetImage seen;
  seen.grey = cv::Mat(kImage, CV_8UC1, cv::Scalar(100));
  seen.matched16 = cv::Mat(kImage, CV_16SC1, cv::Scalar(0));
  const vision::stereo::StereoGeometry geometry{80.0, 31.5, 23.5, 0.3};
  const cv::Mat nothing = panel(draw(seen, pyramid, geometry, 60.0), 5).clone();
  seen.target = cv::Point(40, 32);
  seen.target_radius_px = 9;
  const cv::Mat ringed = panel(draw(seen, pyramid, geometry, 60.0), 5);
  EXPECT_NE(ringed.at<cv::Vec3b>(32, 49), nothing.at<cv::Vec3b>(32, 49));
  EXPECT_NE(ringed.at<cv::Vec3b>(41, 40), nothing.at<cv::Vec3b>(41, 40));
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
