#include "vision/stereo/semi_global_matcher.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "vision/stereo/stereo_matcher.h"

/// Compares every value with OpenCV's matcher, because flights must be reproducible bit for bit.
namespace hedgehop::vision::stereo {
namespace {

struct Task {
  int disparities_px, block_px;
  cv::Size image;
  friend std::ostream& operator<<(std::ostream& out, const Task& task) {
    return out << task.disparities_px << "_" << task.block_px << "_" << task.image.width << "x" << task.image.height;
  }
};

cv::Mat random_image(uint64_t seed, cv::Size size, int levels) {
  cv::Mat image(size, CV_8UC1);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, levels);
  return image * (255 / (levels - 1));
}

cv::Mat smooth_image(uint64_t seed, cv::Size size) {
  cv::Mat image = random_image(seed, size, 256);
  cv::GaussianBlur(image, image, {}, 1.2);
  return 4 * (image - 96);
}

void expect_as_opencv(const Task& task, const cv::Mat& left, const cv::Mat& right, const std::string& what) {
  cv::Mat wide_left, wide_right, expected;
  for (const auto& [image, wide] : {std::pair(&left, &wide_left), std::pair(&right, &wide_right)}) {
    cv::copyMakeBorder(*image, *wide, 0, 0, task.disparities_px, 0, cv::BORDER_REPLICATE);
  }
  const cv::Rect inner({task.disparities_px, 0}, left.size());
  const StereoMatcherConfig config{.disparities_px = task.disparities_px, .block_px = task.block_px};
  opencv_semi_global(config)->compute(wide_left, wide_right, expected);
  for (const bool narrow : {false, true}) {
    SemiGlobalMatcher matcher({.disparities_px = task.disparities_px, .block_px = task.block_px, .narrow = narrow},
                              wide_left.size());
    cv::Mat found;
    for (int time = 0; time < 2; ++time) matcher.compute(wide_left, wide_right, found);
    EXPECT_EQ(cv::countNonZero(found(inner) != expected(inner)), 0) << what << (narrow ? ", narrow" : "");
  }
}

class SemiGlobalEqualsOpenCv : public testing::TestWithParam<Task> {};

TEST_P(SemiGlobalEqualsOpenCv, ForMatchableAndUnmatchableImages) {
  const Task& task = GetParam();
  const cv::Mat left = smooth_image(1, task.image);
  cv::Mat shifted;
  const cv::Mat slanted = (cv::Mat_<double>(2, 3) << 1.02, 0.05, -6.3, 0.0, 1.0, 0.0);
  cv::warpAffine(left, shifted, slanted, left.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  expect_as_opencv(task, left, shifted, "a slanted wall");
  expect_as_opencv(task, left, smooth_image(2, task.image), "another image");
  // Maximum costs: sums saturate.
  expect_as_opencv(task, random_image(3, task.image, 2), random_image(4, task.image, 2), "black and white");
  expect_as_opencv(task, random_image(5, task.image, 2), cv::Mat(task.image, CV_8UC1, cv::Scalar(0)), "black");
  // Zero costs, many of them equal.
  expect_as_opencv(task, cv::Mat(task.image, CV_8UC1, cv::Scalar(90)), cv::Mat(task.image, CV_8UC1, cv::Scalar(90)),
                   "plain");
}

INSTANTIATE_TEST_SUITE_P(Sizes, SemiGlobalEqualsOpenCv,
                         testing::Values(Task{16, 1, {50, 31}}, Task{16, 3, {160, 120}}, Task{32, 5, {320, 240}},
                                         Task{48, 5, {161, 97}}, Task{32, 11, {320, 180}}, Task{64, 13, {101, 60}},
                                         Task{128, 7, {70, 20}}, Task{64, 9, {12, 5}}, Task{16, 5, {3, 2}}),
                         testing::PrintToStringParamName());

TEST(SemiGlobalMatcher, EqualsOpenCvForASyntheticNoisyPair) {
  const std::string folder = HEDGEHOP_SOURCE_DIR "/tests/vision/images/";
  const cv::Mat left = cv::imread(folder + "left.png", cv::IMREAD_GRAYSCALE);
  const cv::Mat right = cv::imread(folder + "right.png", cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(left.empty());
  for (const int block_px : {5, 9, 11}) expect_as_opencv({32, block_px, left.size()}, left, right, "a room");
}

}  // namespace
}  // namespace hedgehop::vision::stereo
