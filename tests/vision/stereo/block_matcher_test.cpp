#include "vision/stereo/block_matcher.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/vision/stereo/stereo_pairs.h"
#include "vision/stereo/stereo_matcher.h"

/// Compares every value with OpenCV's matcher, because flights must be reproducible bit for bit.
namespace hedgehop::vision::stereo {
namespace {

void expect_as_opencv(const StereoMatcherConfig& config, const StereoPair& pair) {
  const int margin_px = config.disparities_px;
  const cv::Mat left = with_margin(pair.left, margin_px), right = with_margin(pair.right, margin_px);
  const cv::Rect inner({margin_px, 0}, pair.left.size());
  cv::Mat expected, found;
  opencv_block(config)->compute(left, right, expected);
  for (const int lanes : {8, 16, 32}) {
    BlockMatcher matcher({.disparities_px = config.disparities_px,
                          .block_px = config.block_px,
                          .uniqueness_percent = config.uniqueness_percent,
                          .texture = config.texture,
                          .left_right_px = config.left_right_px,
                          .max_lanes = lanes},
                         left.size());
    for (int time = 0; time < 2; ++time) matcher.compute(left, right, found);
    EXPECT_EQ(cv::countNonZero(found(inner) != expected(inner)), 0) << pair.what << ", " << lanes << " lanes";
  }
}

class BlockEqualsOpenCv : public testing::TestWithParam<Task> {};

TEST_P(BlockEqualsOpenCv, ForMatchableAndUnmatchableImages) {
  const Task& task = GetParam();
  for (const StereoPair& pair : stereo_pairs(task.image)) {
    StereoMatcherConfig config{
        .method = StereoMatcherConfig::Method::block, .disparities_px = task.disparities_px, .block_px = task.block_px};
    expect_as_opencv(config, pair);
    config.texture = 20 * task.block_px * task.block_px;
    expect_as_opencv(config, pair);
    config.texture = 0;
    config.left_right_px = -1;
    expect_as_opencv(config, pair);
    config.uniqueness_percent = 0;
    config.left_right_px = 0;
    expect_as_opencv(config, pair);
  }
}

// Odd and even numbers of rows; OpenCV divides tall images into strips.
INSTANTIATE_TEST_SUITE_P(Sizes, BlockEqualsOpenCv,
                         testing::Values(Task{16, 5, {50, 31}}, Task{32, 9, {320, 240}}, Task{48, 11, {161, 97}},
                                         Task{64, 11, {320, 180}}, Task{64, 21, {101, 60}}, Task{96, 7, {65, 40}},
                                         Task{128, 7, {70, 20}}, Task{64, 15, {15, 17}}, Task{32, 5, {64, 1200}}),
                         testing::PrintToStringParamName());

TEST(BlockMatcher, EqualsOpenCvForASyntheticNoisyPair) {
  const std::string folder = HEDGEHOP_SOURCE_DIR "/tests/vision/images/";
  const cv::Mat left = cv::imread(folder + "left.png", cv::IMREAD_GRAYSCALE);
  const cv::Mat right = cv::imread(folder + "right.png", cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(left.empty());
  for (const int block_px : {5, 11, 21}) {
    expect_as_opencv({.method = StereoMatcherConfig::Method::block, .disparities_px = 32, .block_px = block_px},
                     {"a room", left, right});
  }
}

TEST(BlockMatcher, LeavesImagesSmallerThanABlockUnmatched) {
  const cv::Mat image = with_margin(smooth_image(1, {40, 8}), 32);
  cv::Mat found;
  BlockMatcher({.disparities_px = 32, .block_px = 9}, image.size()).compute(image, image, found);
  EXPECT_EQ(cv::countNonZero(found >= 0), 0);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
