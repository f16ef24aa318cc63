#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/best_disparity.h"

namespace hedgehop::vision::stereo {

/// Parameters of block matching.
struct BlockConfig {
  int disparities_px = 64;      ///< number of disparities, from 0; a multiple of 16
  int block_px = 9;             ///< side of the compared blocks; odd, at most kMaxBlockPx
  int uniqueness_percent = 10;  ///< required margin of the best match over the second, >= 0
  int texture = 10;             ///< minimum sum of a block's absolute slopes
  int left_right_px = 1;        ///< maximum difference of the matches from both sides; negative: not compared
  int max_lanes = 32;           ///< maximum number of disparities to process at a time; the results are equal
};

/// Computes the disparity of rectified pairs from the sum of absolute differences of slopes over blocks. The result
/// equals that of OpenCV's StereoBM (Sobel filter limited to 31) bit for bit, in less time.
class BlockMatcher {
 public:
  static constexpr int kMaxBlockPx = 21;  ///< larger sums exceed 16 bits

  /// @param size  of the images including the left margin of `disparities_px` columns; at least one column more.
  BlockMatcher(const BlockConfig& config, cv::Size size);

  cv::Size size() const { return {width_ + config_.disparities_px, height_}; }

  /// Computes the disparity. @param left, right  CV_8UC1, of the given size. @param disparity16  CV_16SC1, as in
  /// vision/stereo/disparity.h, negative in the margin and closer to the other edges than half a block.
  void compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16);

 private:
  void add_row(int y, bool whole);
  void choose_disparities();
  void check_right_consistency();

  BlockConfig config_;
  int width_, height_;                    ///< without the margin
  cv::Mat left_, right_, no_slopes_;      ///< slopes along the rows
  std::vector<int16_t> columns_, block_;  ///< differences summed over the rows of a block, and over a block
  std::vector<int16_t> column_textures_;  ///< absolute slopes summed over the rows of a block; with zeros at both ends
  std::vector<int16_t> textures_;         ///< of the blocks
  WinnerRow winners_;
  std::vector<int> dividends_, divisors_;  ///< of the fractions of a pixel
  std::vector<int16_t> found_;             ///< disparity x 16 in a row
  std::vector<int> right_matches_;  ///< cost and disparity x 16 of the best match of each pixel in the right image
};

}  // namespace hedgehop::vision::stereo
