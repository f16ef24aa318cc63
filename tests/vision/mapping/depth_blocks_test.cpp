#include "vision/mapping/depth_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {
namespace {

TEST(DepthBlocks, BlockHasTheDisparityOfAPoleInIt) {
  cv::Mat disparity16(8, 8, CV_16SC1, cv::Scalar(16));
  disparity16.colRange(3, 5).setTo(200);
  DepthBlocks blocks;
  blocks.build(disparity16, {}, 0);
  EXPECT_EQ(blocks.at(0, 0).kind, DepthBlock::Kind::matched);
  EXPECT_EQ(blocks.at(0, 0).near16, 200);
}

// A window of 11 px matches 5 px of an untextured wall with the adjacent texture; an unmatched speck is not a wall.
TEST(DepthBlocks, BlocksNextToUntexturedAreasAreSmeared) {
  constexpr int kWallPx = 40, kSmearPx = 5, kFar16 = 20;
  cv::Mat disparity16(64, 80, CV_16SC1, cv::Scalar(kFar16));
  disparity16.colRange(kWallPx + kSmearPx, 80).setTo(stereo::kNoDisparity);
  disparity16(cv::Rect(10, 30, 3, 3)).setTo(stereo::kNoDisparity);
  DepthBlocks blocks;
  blocks.build(disparity16, {}, kSmearPx);
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      const DepthBlock& block = blocks.at(row, col);
      if (8 * (col + 1) <= kWallPx) {
        EXPECT_EQ(block.kind, DepthBlock::Kind::matched) << row << " " << col;
      } else {
        EXPECT_NE(block.kind, DepthBlock::Kind::matched) << row << " " << col;
      }
    }
    EXPECT_EQ(blocks.at(row, kWallPx / 8).kind, DepthBlock::Kind::smeared);
    EXPECT_EQ(blocks.at(row, kWallPx / 8).near16, kFar16);
  }
}

TEST(DepthBlocks, BlockWithFewMatchesIsUnknown) {
  cv::Mat disparity16(8, 8, CV_16SC1, cv::Scalar(stereo::kNoDisparity));
  disparity16.rowRange(0, 3).setTo(40);
  DepthBlocks blocks;
  blocks.build(disparity16, {}, 0);
  EXPECT_EQ(blocks.at(0, 0).kind, DepthBlock::Kind::unknown);
  EXPECT_EQ(blocks.at(0, 0).near16, 40);
}

TEST(DepthBlocks, LineNearerThanItsBlockIsTheNearestSurface) {
  DepthBlocks blocks;
  blocks.build(cv::Mat(8, 24, CV_16SC1, cv::Scalar(40)), {}, 0, cv::Mat(8, 24, CV_16SC1, cv::Scalar(32)));
  blocks.add_lines((cv::Mat_<int16_t>(1, 3) << 90, 20, -1));
  EXPECT_EQ(blocks.at(0, 0).near16, 90);
  EXPECT_TRUE(blocks.at(0, 0).thin);
  EXPECT_EQ(blocks.at(0, 0).sigma16, -1);
  for (const int col : {1, 2}) {
    EXPECT_EQ(blocks.at(0, col).near16, 40) << col;
    EXPECT_FALSE(blocks.at(0, col).thin) << col;
  }
}

// The oracle sorts the disparities of each block.
TEST(DepthBlocks, NearestDisparityIsThatOfASortedBlock) {
  cv::Mat disparity16(160, 240, CV_16SC1);
  cv::RNG random(5);
  random.fill(disparity16, cv::RNG::UNIFORM, -16, 48);
  cv::Mat other(disparity16.size(), CV_16SC1);
  random.fill(other, cv::RNG::UNIFORM, -1000, 600);
  other.colRange(0, 120).copyTo(disparity16.colRange(0, 120));
  DepthBlocks blocks;
  blocks.build(disparity16, {}, 0);
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      std::vector<int16_t> matched;
      for (int i = 0; i < 64; ++i) {
        const auto d = disparity16.at<int16_t>(8 * row + i / 8, 8 * col + i % 8);
        if (d >= 0) matched.push_back(d);
      }
      std::ranges::sort(matched, std::greater<>());
      const int expected = matched.size() < 6 ? -1 : matched[std::max<size_t>(2, matched.size() / 16)];
      EXPECT_EQ(blocks.at(row, col).near16, expected) << row << " " << col;
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::mapping
