#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/loop/pixel_levels.h"

namespace hedgehop::sim {
namespace {

constexpr int kSize = 1000;
constexpr double kCount = kSize * kSize;

cv::Mat normal(uint64_t seed) {
  cv::Mat image(kSize, kSize, CV_32F);
  fill_normal(seed, image);
  return image;
}

/// Mean of the products of numbers that lie so far apart.
double correlation(const cv::Mat& image, int right, int down) {
  const cv::Size size(kSize - right, kSize - down);
  return image(cv::Rect({0, 0}, size)).dot(image(cv::Rect({right, down}, size))) / size.area();
}

double power_mean(const cv::Mat& image, int power) {
  double sum = 0.0;
  for (const float number : cv::Mat_<float>(image)) sum += std::pow(number, power);
  return sum / kCount;
}

// Of n standard normal numbers, these means scatter by sqrt(1, 2, 15, 96 / n) round 0, 1, 0 and 3.
TEST(NormalImage, HasTheMomentsOfTheNormalDistribution) {
  const cv::Mat image = normal(1);
  EXPECT_NEAR(power_mean(image, 1), 0.0, 4.0 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(power_mean(image, 2), 1.0, 4.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(power_mean(image, 3), 0.0, 4.0 * std::sqrt(15.0 / kCount));
  EXPECT_NEAR(power_mean(image, 4), 3.0, 4.0 * std::sqrt(96.0 / kCount));
}

// Kolmogorov and Smirnov: the largest distance from the distribution exceeds 1.95 / sqrt(n) in one of a thousand.
TEST(NormalImage, FollowsTheNormalDistribution) {
  const cv::Mat image = normal(2);
  std::vector<float> sorted(image.begin<float>(), image.end<float>());
  std::ranges::sort(sorted);
  double distance = 0.0;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const double share = 0.5 * std::erfc(-static_cast<double>(sorted[i]) / std::sqrt(2.0));
    distance = std::max(distance, std::abs(share - static_cast<double>(i + 1) / kCount));
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(kCount));
  EXPECT_LT(sorted.back(), 4.4F);
  EXPECT_GT(sorted.front(), -4.4F);
}

TEST(NormalImage, NeighborsRowsAndSeedsAreUnrelated) {
  const cv::Mat image = normal(3), next = normal(4);
  const double allowed = 4.0 / std::sqrt(kCount);
  for (int right = 0; right <= 9; ++right) {
    for (int down = right == 0 ? 1 : 0; down <= 3; ++down) {
      EXPECT_NEAR(correlation(image, right, down), 0.0, allowed) << right << ", " << down;
    }
  }
  EXPECT_NEAR(image.dot(next) / kCount, 0.0, allowed);
  const cv::Mat magnitude = cv::abs(image) - std::sqrt(2.0 / CV_PI);
  EXPECT_NEAR(correlation(magnitude, 1, 0), 0.0, allowed);
}

TEST(NormalImage, DependsOnTheSeedAloneAlsoInPartsOfImagesAndOddSizes) {
  cv::Mat whole(7, 13, CV_32FC3, cv::Scalar::all(9.0)), large(20, 20, CV_32FC3, cv::Scalar::all(9.0));
  cv::Mat part = large(cv::Rect(2, 3, 13, 7));
  fill_normal(5, whole);
  fill_normal(5, part);
  EXPECT_EQ(cv::norm(whole, part, cv::NORM_INF), 0.0);
  EXPECT_EQ(large.at<cv::Vec3f>(2, 2), cv::Vec3f(9, 9, 9));
  EXPECT_EQ(large.at<cv::Vec3f>(3, 15), cv::Vec3f(9, 9, 9));
  fill_normal(6, part);
  EXPECT_GT(cv::norm(whole, part, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
