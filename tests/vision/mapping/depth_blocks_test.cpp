#include "vision/mapping/depth_blocks.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hedgehop::vision::mapping
