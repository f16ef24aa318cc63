#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/semi_global_paths.h"

namespace hedgehop::vision::stereo {

/// Differences between the pixels of one row of a rectified pair, at each disparity: in brightness and in slope along
/// the row. The image is linear between pixels, so that shifts of up to half a pixel cause no difference. Source:
/// [Hirschmuller2008] sec. 2.1, after Birchfield and Tomasi.
class PixelCosts {
 public:
  static constexpr int kMaxCost = 125;

  /// @param disparities_px  number of disparities from 0, a multiple of 16. The images have a left margin of that many
  /// columns, for which no disparities are computed.
  PixelCosts(int width_px, int disparities_px);

  /// Computes the costs of row y. @param left, right  CV_8UC1, `width_px` wide. @param costs  for each column right of
  /// the margin the costs of all disparities, largest first: (width_px - disparities_px) x disparities_px.
  void row(const cv::Mat& left, const cv::Mat& right, int y, uint8_t* costs);

 private:
  /// Brightness or slope of a row's pixels, and the minimum and maximum within half a pixel of each.
  struct PixelLine {
    explicit PixelLine(int width_px) : at(static_cast<size_t>(width_px)), low(at), high(at) {}
    void find_extrema();
    std::vector<uint8_t> at, low, high;
  };
  using PixelLines = std::array<PixelLine, 2>;  ///< slope, brightness
  static void read(const cv::Mat& image, int y, PixelLines& lines);

  int disparities_;
  PixelLines left_, right_;
};

/// Parameters of semi-global matching.
struct SemiGlobalConfig {
  int disparities_px = 64;      ///< number of disparities, from 0; a multiple of 16
  int block_px = 5;             ///< side of the blocks over which costs are summed; odd, at most kMaxBlockPx
  int uniqueness_percent = 10;  ///< required margin of the best match over the second, 0 to 99
  int left_right_px = 1;        ///< maximum difference of the matches from both sides, >= 1
  int max_lanes = 32;           ///< maximum number of disparities to process at a time; the results are equal
};

/// Computes the disparity of rectified pairs from block costs aggregated along five directions: from the left, the
/// right, and the three neighbors above. The result equals that of OpenCV's StereoSGBM (MODE_SGBM, 3 x 3 median) bit
/// for bit, in less time. Source: [Hirschmuller2008] eq. (13), (14) and sec. 2.3.
class SemiGlobalMatcher {
 public:
  static constexpr int kMaxBlockPx = 13;  ///< larger sums exceed 16 bits

  /// @param size  of the images including the left margin of `disparities_px` columns; at least one column more.
  SemiGlobalMatcher(const SemiGlobalConfig& config, cv::Size size);

  cv::Size size() const { return {width_ + config_.disparities_px, height_}; }

  /// Computes the disparity. @param left, right  CV_8UC1, of the given size. @param disparity16  CV_16SC1, as in
  /// vision/stereo/disparity.h, negative in the margin.
  void compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16);

 private:
  void add_row(const cv::Mat& left, const cv::Mat& right, int y);
  void choose_disparities(int16_t* disparity16);
  void check_right_consistency(int16_t* disparity16) const;

  SemiGlobalConfig config_;
  int width_, height_;  ///< without the margin
  PixelCosts pixel_costs_;
  std::vector<uint8_t> pixels_;   ///< costs of the pixels in a block's rows and one more, as a ring buffer
  std::vector<int16_t> columns_;  ///< costs summed over the rows of a block around the first row
  PathCosts paths_;
  std::vector<int> right_matches_;  ///< disparity of each pixel of the right image; negative if unmatched
  std::vector<int> matches_, dividends_, divisors_;  ///< of the pixels of a row
  cv::Mat found_;
};

}  // namespace hedgehop::vision::stereo
