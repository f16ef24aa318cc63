#include "sim/loop/pixel_levels.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

namespace hedgehop::sim {
namespace {

/// A part of a larger image: rows are not contiguous, and their ends are not multiples of four.
cv::Mat random_levels(int type, int seed) {
  cv::Mat whole(40, 50, type);
  cv::RNG(static_cast<uint64_t>(seed)).fill(whole, cv::RNG::UNIFORM, 0, 256);
  return whole(cv::Rect(3, 2, 37, 31));
}

cv::Mat random_response(const cv::Mat& image) {
  cv::Mat response(image.size(), CV_32FC(image.channels()));
  cv::RNG(7).fill(response, cv::RNG::NORMAL, 0.9, 0.05);
  return response;
}

/// The steps one by one, each by OpenCV.
cv::Mat read_out_by_steps(const cv::Mat& response, double gain, const std::optional<LevelNoise>& noise,
                          const cv::Mat& image) {
  cv::Mat levels, sigma;
  image.convertTo(levels, CV_32F);
  if (!response.empty()) cv::multiply(levels, response, levels);
  levels *= gain;
  if (noise) {
    cv::min(levels, 255.0, levels);
    levels.convertTo(sigma, CV_32F, noise->variance_per_level);
    cv::add(sigma, cv::Scalar::all(noise->read_variance), sigma);
    cv::sqrt(sigma, sigma);
    cv::Mat normal(levels.size(), levels.type());
    fill_normal(noise->seed, normal);
    cv::multiply(normal, sigma, normal);
    levels += normal;
  }
  cv::Mat result;
  levels.convertTo(result, CV_8U);
  return result;
}

TEST(PixelLevels, ReadingOutInOnePassHasTheBitsOfSingleSteps) {
  const std::optional<LevelNoise> none, day = LevelNoise{5, 255.0 / 8000.0, 1.0}, strong = LevelNoise{6, 0.7, 30.0};
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const auto& noise : {none, day, strong}) {
      for (const double gain : {1.0, 0.77, 3.1}) {
        for (const bool uneven : {false, true}) {
          cv::Mat image = random_levels(type, 1);
          const cv::Mat response = uneven ? random_response(image) : cv::Mat();
          const cv::Mat expected = read_out_by_steps(response, gain, noise, image);
          read_out(response, gain, noise, image);
          EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0.0) << type << ", gain " << gain << ", " << uneven;
        }
      }
    }
  }
}

TEST(PixelLevels, PixelsOutsideTheImageKeepTheirLevels) {
  cv::Mat whole(10, 21, CV_8UC1, cv::Scalar(9.0));
  cv::Mat part = whole(cv::Rect(2, 1, 13, 8));
  read_out({}, 2.0, {}, part);
  EXPECT_EQ(cv::countNonZero(whole == 18), 13 * 8);
  EXPECT_EQ(cv::countNonZero(whole == 9), 10 * 21 - 13 * 8);
}

TEST(PixelLevels, MeansHaveTheBitsOfSumsInFloats) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const int count : {2, 3, 7, 256}) {
      cv::Mat image = random_levels(type, 0), sums, float_sums, expected;
      image.convertTo(sums, CV_16U);
      image.convertTo(float_sums, CV_32F);
      for (int k = 1; k < count; ++k) {
        random_levels(type, count == 256 ? 0 : k).copyTo(image);
        cv::accumulate(image, float_sums);
        if (k < count - 1) add_levels(image, sums);
      }
      float_sums.convertTo(expected, CV_8U, 1.0 / count);
      mean_levels(sums, image, count, image);
      EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0.0) << type << ", " << count << " images";
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
