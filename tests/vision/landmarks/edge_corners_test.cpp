#include "vision/landmarks/edge_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;

constexpr int kSizePx = 320;
constexpr double kMinAngleRad = 0.2;

/// A polygon with antialiased edges, drawn at eight times the size and averaged.
void draw(cv::Mat& image, const std::vector<Vector2d>& corners_px, const cv::Scalar& color) {
  constexpr int kFiner = 8;
  std::vector<cv::Point> fine;
  for (const Vector2d& c : corners_px) {
    fine.emplace_back(static_cast<int>(std::lround((c.x() + 0.5) * kFiner - 0.5)),
                      static_cast<int>(std::lround((c.y() + 0.5) * kFiner - 0.5)));
  }
  cv::Mat large;
  cv::resize(image, large, {}, kFiner, kFiner, cv::INTER_NEAREST);
  cv::fillConvexPoly(large, fine, color);
  cv::resize(large, image, image.size(), 0.0, 0.0, cv::INTER_AREA);
}

/// A quadrilateral around the center of the image, without small angles or short sides.
std::vector<Vector2d> random_quadrilateral(std::mt19937_64& random) {
  std::vector<Vector2d> corners;
  const double turn = uniform(random, 0.0, 1.5);
  for (int k = 0; k < 4; ++k) {
    const double angle = turn + 0.5 * M_PI * k + uniform(random, -0.3, 0.3), radius_px = uniform(random, 70.0, 140.0);
    corners.emplace_back(0.5 * kSizePx + radius_px * std::cos(angle), 0.5 * kSizePx + radius_px * std::sin(angle));
  }
  return corners;
}

double distance_px(const std::vector<Vector2d>& corners, const Vector2d& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& c : corners) least = std::min(least, (c - to).norm());
  return least;
}

/// Grey noise at one scale: light and dark patches without straight edges.
cv::Mat patches(uint64_t seed, double scale_px, double amplitude) {
  cv::Mat noise(kSizePx, kSizePx, CV_32F);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(noise, noise, {}, scale_px);
  cv::Mat image;
  noise.convertTo(image, CV_8U, amplitude * scale_px * 3.5, 100.0);
  return image;
}

TEST(EdgeCorners, AreTheCornersOfAQuadrilateral) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Vector2d> corners = random_quadrilateral(random);
    cv::Mat image(kSizePx, kSizePx, CV_8UC1, cv::Scalar(60));
    draw(image, corners, 160);
    const std::vector<Vector2d> found = edge_corners(image, kMinAngleRad);
    EXPECT_EQ(found.size(), 4U) << "round " << round;
    constexpr double kLineFitPx = 1.0;
    for (const Vector2d& corner : corners) EXPECT_LT(distance_px(found, corner), kLineFitPx) << "round " << round;
  }
}

// Amplitude of the patches and contrast to them, 12 and 45 grey levels, as measured in rendered images of towers.
TEST(EdgeCorners, IgnorePatchesOfGrass) {
  std::mt19937_64 random(4);
  int found_of_true = 0, found_elsewhere = 0, grey_elsewhere = 0;
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector2d> corners = random_quadrilateral(random);
    cv::Mat image = patches(static_cast<uint64_t>(round + 1), 3.0, 12.0);
    draw(image, corners, 145);
    const std::vector<Vector2d> found = edge_corners(image, kMinAngleRad);
    for (const Vector2d& corner : corners) found_of_true += distance_px(found, corner) < 3.0;
    for (const Vector2d& place : found) found_elsewhere += distance_px(corners, place) >= 3.0;

    std::vector<cv::Point2f> shi_tomasi;
    cv::goodFeaturesToTrack(image, shi_tomasi, 200, 0.1, 5.0);
    for (const cv::Point2f& p : shi_tomasi) grey_elsewhere += distance_px(corners, {p.x, p.y}) >= 3.0;
  }
  EXPECT_GT(grey_elsewhere, 4 * kRounds) << "the patches must be hard for corners of grey";
  constexpr double kOfOneImage = 0.75;  // patches of equal brightness interrupt an edge; they differ in the next image
  EXPECT_GE(found_of_true, kOfOneImage * 4 * kRounds);
  EXPECT_LE(found_elsewhere, 0.1 * 4 * kRounds);
}

TEST(EdgeCorners, SeparateRedAndGreenOfEqualGreyInColor) {
  const std::vector<Vector2d> corners = {{60, 70}, {250, 60}, {260, 240}, {80, 250}};
  const cv::Scalar green(60, 110, 60), red(125, 75, 75);
  cv::Mat image(kSizePx, kSizePx, CV_8UC3, green);
  draw(image, corners, red);
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
  EXPECT_TRUE(edge_corners(grey, kMinAngleRad).empty());
  EXPECT_EQ(edge_corners(image, kMinAngleRad).size(), 4U);
}

TEST(EdgeCorners, AreIntersectionsOfLines) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    const Vector2d at(uniform(random, 0, 300), uniform(random, 0, 300));
    const double first = uniform(random, 0, 6.28), second = first + uniform(random, 0.3, 2.8);
    const auto edge = [&](double angle) {
      const Vector2d along(std::cos(angle), std::sin(angle));
      return ImageEdge{at + uniform(random, -2, 5) * along, at + uniform(random, 40, 90) * along};
    };
    const std::vector<ImageEdge> edges = {edge(first), edge(second)};
    const auto corners = corners_of(edges, kMinAngleRad);
    ASSERT_EQ(corners.size(), 1U);
    EXPECT_LT((corners[0] - at).norm(), 1e-9);
  }
}

// In steep views of a wall's base the detector's segments cut the corner: one of them starts on the first
// line and ends on the second, and a part of the second is missing.
TEST(EdgeCorners, AreFoundAtSlightBendsOfALine) {
  constexpr double kDegree = M_PI / 180.0;
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    const Vector2d at(uniform(random, 0, 300), uniform(random, 0, 300));
    const double turn = uniform(random, 0, 6.28), bend = uniform(random, 9.0 * kDegree, 20.0 * kDegree);
    const auto first = [&](double s) { return Vector2d(at + s * Vector2d(std::cos(turn), std::sin(turn))); };
    const auto second = [&](double s) {
      return Vector2d(at + s * Vector2d(std::cos(turn + bend), std::sin(turn + bend)));
    };
    const double cut_px = uniform(random, 0.3, 0.9) * kAsidePx / std::sin(bend);
    const double late_px = uniform(random, 1.0, 1.9) * kAsidePx / std::sin(bend);
    const std::vector<ImageEdge> pieces = {
        {first(-200), first(-10)}, {first(-8), second(cut_px)}, {second(late_px), second(150)}};
    const auto corners = corners_of(joined_edges(pieces), 8.0 * kDegree);
    ASSERT_EQ(corners.size(), 1U) << "round " << round;
    constexpr double kCutPieceTurnsTheLinePx = 2.0;
    EXPECT_LT((corners[0] - at).norm(), kCutPieceTurnsTheLinePx) << "round " << round;
  }
}

TEST(EdgeCorners, ExcludeAnEdgeThatPassesThroughAnothersEnd) {
  const std::vector<ImageEdge> edges = {{{0, 0}, {100, 0}}, {{50, 1}, {50, 80}}};
  EXPECT_TRUE(corners_of(edges, kMinAngleRad).empty());
}

// Ground and wall are equally bright along the last 12 px of the wall's base; the other 88 px give its direction.
TEST(EdgeCorners, AreFoundIfALongEdgeEndsBeforeItsCorner) {
  const std::vector<ImageEdge> edges = {{{0, 0}, {88, 0}}, {{100, 0}, {100, -80}}};
  const auto corners = corners_of(edges, kMinAngleRad);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_LT((corners[0] - Vector2d(100, 0)).norm(), 1e-9);
  const std::vector<ImageEdge> shorter = {{{40, 0}, {88, 0}}, {{100, 0}, {100, -80}}};
  EXPECT_TRUE(corners_of(shorter, kMinAngleRad).empty());
}

// The noise of sensors/day.yaml at middle grey, a lens's blur of 0.7 px, and a contrast of 12 grey levels, six times
// the noise.
TEST(EdgeCorners, AreFoundAtLowContrastWithBlurAndNoise) {
  constexpr double kBlurPx = 0.7, kNoise = 2.0, kContrast = 12.0;
  constexpr int kRounds = 40;
  std::mt19937_64 random(9);
  cv::RNG noise_random(9);
  int found_of_true = 0, found_elsewhere = 0;
  double squares_px2 = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector2d> corners = random_quadrilateral(random);
    cv::Mat image(kSizePx, kSizePx, CV_8UC1, cv::Scalar(100)), noise(kSizePx, kSizePx, CV_16SC1);
    draw(image, corners, 100 + kContrast);
    cv::GaussianBlur(image, image, {}, kBlurPx);
    noise_random.fill(noise, cv::RNG::NORMAL, 0.0, kNoise);
    cv::add(image, noise, image, {}, CV_8U);
    const std::vector<Vector2d> found = edge_corners(image, kMinAngleRad);
    for (const Vector2d& corner : corners) {
      const double off_px = distance_px(found, corner);
      if (off_px >= 3.0) continue;
      ++found_of_true;
      squares_px2 += off_px * off_px;
    }
    for (const Vector2d& place : found) found_elsewhere += distance_px(corners, place) >= 3.0;
  }
  EXPECT_GE(found_of_true, 0.95 * 4 * kRounds);
  EXPECT_LE(found_elsewhere, 0.02 * 4 * kRounds);
  constexpr double kPerAxisPx = 0.5;  // half of the value in configs/shah2009_*.yaml
  EXPECT_LT(std::sqrt(squares_px2 / found_of_true), kPerAxisPx * std::sqrt(2.0));
}

TEST(EdgeCorners, ExcludeEdgesThatEndFarApart) {
  const std::vector<ImageEdge> edges = {{{0, 0}, {100, 0}}, {{130, 30}, {130, 90}}};
  EXPECT_TRUE(corners_of(edges, kMinAngleRad).empty());
}

TEST(JoinedEdges, SegmentsOfALineAreOneEdge) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 100; ++round) {
    const Vector2d from(uniform(random, 0, 300), uniform(random, 0, 300));
    const double angle = uniform(random, 0, 6.28), length_px = uniform(random, 60, 250);
    const Vector2d along(std::cos(angle), std::sin(angle)), aside(-along.y(), along.x());
    std::vector<ImageEdge> pieces;
    double at_px = 0.0;
    while (at_px < length_px) {
      const double end_px = std::min(length_px, at_px + uniform(random, 15, 40));
      pieces.push_back({from + at_px * along + uniform(random, -0.1, 0.1) * aside,
                        from + end_px * along + uniform(random, -0.1, 0.1) * aside});
      at_px = end_px + uniform(random, 1, 0.8 * kGapPx);
    }
    const double whole_px = length_px;
    std::ranges::shuffle(pieces, random);
    const auto edges = joined_edges(pieces);
    ASSERT_EQ(edges.size(), 1U) << "round " << round;
    constexpr double kWobblePx = 0.5;
    EXPECT_LT(std::min((edges[0].from_px - from).norm(), (edges[0].to_px - from).norm()), kWobblePx);
    EXPECT_LT(edges[0].length_px(), whole_px + kWobblePx);
  }
}

// Dark to light, then light to dark: a roof's edge, and a streak of grass in the same direction.
TEST(JoinedEdges, OppositeSegmentsRemainTwo) {
  const std::vector<ImageEdge> pieces = {{{0, 0}, {50, 0}}, {{100, 0}, {55, 0}}};
  EXPECT_EQ(joined_edges(pieces).size(), 2U);
}

TEST(JoinedEdges, ParallelLinesRemainTwo) {
  const std::vector<ImageEdge> pieces = {
      {{0, 0}, {50, 0}}, {{60, 0}, {100, 0}}, {{0, 5}, {50, 5}}, {{60, 5}, {100, 5}}};
  EXPECT_EQ(joined_edges(pieces).size(), 2U);
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
