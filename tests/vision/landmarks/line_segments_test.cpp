#include "vision/landmarks/edge_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;

constexpr int kSegmentImagePx = 200;

/// A half-plane, bright to the right of a line through `at`. Pixels on the line are blended by area to first order;
/// with white noise.
cv::Mat half_plane(const Vector2d& at, double angle_rad, double contrast, double noise, cv::RNG& random) {
  const Vector2d right(-std::sin(angle_rad), std::cos(angle_rad));  // in the image, whose v points down
  cv::Mat image(kSegmentImagePx, kSegmentImagePx, CV_8UC1);
  for (int v = 0; v < kSegmentImagePx; ++v) {
    for (int u = 0; u < kSegmentImagePx; ++u) {
      const double share = std::clamp(0.5 + right.dot(Vector2d(u, v) - at), 0.0, 1.0);
      image.at<uchar>(v, u) = cv::saturate_cast<uchar>(90.0 + contrast * share + random.gaussian(noise));
    }
  }
  return image;
}

TEST(LineSegments, LieOnAStraightEdgeWithTheBrighterSideOnTheRight) {
  std::mt19937_64 random(1);
  cv::RNG noise(1);
  for (int round = 0; round < 60; ++round) {
    const Vector2d at(uniform(random, 80, 120), uniform(random, 80, 120));
    const double angle = uniform(random, 0, 6.28);
    const Vector2d along(std::cos(angle), std::sin(angle)), aside(-along.y(), along.x());
    const auto edges = line_segments(half_plane(at, angle, 40.0, 1.0, noise));
    ASSERT_FALSE(edges.empty()) << "round " << round;
    constexpr double kOffPx = 0.15, kPixelBesidePx = 1.0, kOfTheImagePx = 150.0;
    double longest_px = 0.0;
    for (const ImageEdge& edge : edges) {
      const double length_px = along.dot(edge.to_px - edge.from_px);
      const double off_px = std::max(std::abs(aside.dot(edge.from_px - at)), std::abs(aside.dot(edge.to_px - at)));
      EXPECT_GT(length_px, 0.0) << "round " << round;
      EXPECT_LT(off_px, length_px > kOfTheImagePx ? kOffPx : kPixelBesidePx) << "round " << round;
      longest_px = std::max(longest_px, length_px);
    }
    EXPECT_GT(longest_px, kOfTheImagePx) << "round " << round;
  }
}

TEST(LineSegments, NoiseHasNoSegments) {
  cv::RNG random(2);
  for (int round = 0; round < 20; ++round) {
    EXPECT_TRUE(line_segments(half_plane({100, 100}, 0.0, 0.0, 3.0, random)).empty()) << "round " << round;
  }
}

TEST(LineSegments, ImageOfOnePixelHasNoSegments) {
  EXPECT_TRUE(line_segments(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9))).empty());
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
