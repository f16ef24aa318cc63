#include "vision/stereo/semi_global_matcher.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/vision/stereo/stereo_pairs.h"
#include "vision/stereo/stereo_matcher.h"

/// Compares every value with OpenCV's matcher, because flights must be reproducible bit for bit.
namespace hedgehop::vision::stereo {
namespace {

void expect_as_opencv(const Task& task, const StereoPair& pair) {
  const cv::Mat left = with_margin(pair.left, task.disparities_px),
                right = with_margin(pair.right, task.disparities_px);
  const cv::Rect inner({task.disparities_px, 0}, pair.left.size());
  const StereoMatcherConfig config{.disparities_px = task.disparities_px, .block_px = task.block_px};
  cv::Mat expected, found;
  opencv_semi_global(config)->compute(left, right, expected);
  for (const int lanes : {8, 16, 32}) {
    SemiGlobalMatcher matcher({.disparities_px = task.disparities_px, .block_px = task.block_px, .max_lanes = lanes},
                              left.size());
    for (int time = 0; time < 2; ++time) matcher.compute(left, right, found);
    EXPECT_EQ(cv::countNonZero(found(inner) != expected(inner)), 0) << pair.what << ", " << lanes << " lanes";
  }
}

class SemiGlobalEqualsOpenCv : public testing::TestWithParam<Task> {};

TEST_P(SemiGlobalEqualsOpenCv, ForMatchableAndUnmatchableImages) {
  for (const StereoPair& pair : stereo_pairs(GetParam().image)) expect_as_opencv(GetParam(), pair);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SemiGlobalEqualsOpenCv,
                         testing::Values(Task{16, 1, {50, 31}}, Task{16, 3, {160, 120}}, Task{32, 5, {320, 240}},
                                         Task{48, 5, {161, 97}}, Task{32, 11, {320, 180}}, Task{64, 13, {101, 60}},
                                         Task{96, 3, {65, 40}}, Task{128, 7, {70, 20}}, Task{64, 9, {12, 5}},
                                         Task{16, 5, {3, 2}}),
                         testing::PrintToStringParamName());

TEST(SemiGlobalMatcher, EqualsOpenCvForASyntheticNoisyPair) {
  const std::string folder = HEDGEHOP_SOURCE_DIR "/tests/vision/images/";
  const cv::Mat left = cv::imread(folder + "left.png", cv::IMREAD_GRAYSCALE);
  const cv::Mat right = cv::imread(folder + "right.png", cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(left.empty());
  for (const int block_px : {5, 9, 11}) expect_as_opencv({32, block_px, left.size()}, {"a room", left, right});
}

}  // namespace
}  // namespace hedgehop::vision::stereo
