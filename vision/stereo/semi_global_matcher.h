#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/semi_global_paths.h"

namespace hedgehop::vision::stereo {

/// How much the pixels of one row of a rectified pair differ, at each of some disparities: in brightness, and in slope
/// along the row. An image is taken to be linear between pixels, so that none differs from what lies half a pixel
/// aside. Source: [Hirschmuller2008] sec. 2.1, after Birchfield and Tomasi.
class PixelCosts {
 public:
  static constexpr int kMaxCost = 125;  ///< of a cost

  /// @param disparities_px  searched, from 0 on: a multiple of 16. The images have a margin of as many columns on the
  /// left, whose pixels are matched with but not for.
  PixelCosts(int width_px, int disparities_px);

  /// @param left, right  CV_8UC1, `width_px` wide. @param costs  disparities of the first column right of the margin,
  /// largest first, then those of the next: (width_px - disparities_px) x disparities_px.
  void row(const cv::Mat& left, const cv::Mat& right, int y, uint8_t* costs);

 private:
  /// Of a row: brightness or slope of the pixels, and the least and most within half a pixel of each.
  struct PixelLine {
    explicit PixelLine(int width_px) : at(static_cast<size_t>(width_px)), least(at), most(at) {}
    void spread();
    std::vector<uint8_t> at, least, most;
  };
  using PixelLines = std::array<PixelLine, 2>;  ///< slope, brightness
  static void read(const cv::Mat& image, int y, PixelLines& lines);

  int disparities_;
  PixelLines left_, right_;
};

struct SemiGlobalConfig {
  int disparities_px = 64;      ///< searched: 0 to this, less one; a multiple of 16
  int block_px = 5;             ///< side of the squares whose pixels' costs are summed; odd, at most kMaxBlockPx
  int uniqueness_percent = 10;  ///< 0 to 99: by which the best match must beat the second
  int left_right_px = 1;        ///< >= 1: by which matching from either side may differ
  bool narrow = false;          ///< work as on a processor without AVX2: slower, with the same result
};

/// Disparity of rectified pairs by the costs of squares, smoothed along five directions: from the left, the right, and
/// from the three neighbors above. Bit for bit what OpenCV's StereoSGBM (MODE_SGBM, 3 x 3 median) finds, in less time.
/// Source: [Hirschmuller2008] eq. (13), (14) and sec. 2.3.
class SemiGlobalMatcher {
 public:
  static constexpr int kMaxBlockPx = 13;  ///< larger sums would need more than 16 bits

  /// @param size  of the images with their margin: as many columns on the left as disparities, and one more at least.
  SemiGlobalMatcher(const SemiGlobalConfig& config, cv::Size size);

  cv::Size size() const { return {width_ + config_.disparities_px, height_}; }

  /// @param left, right  CV_8UC1, of the size given. @param disparity16  CV_16SC1, as in vision/stereo/disparity.h, but
  /// negative in the margin.
  void compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16);

 private:
  void add_row(const cv::Mat& left, const cv::Mat& right, int y);
  void choose(int16_t* disparity16);
  void check_from_the_right(int16_t* disparity16) const;

  SemiGlobalConfig config_;
  int width_, height_;  ///< without the margin
  PixelCosts pixel_costs_;
  std::vector<uint8_t> pixels_;  ///< costs of the pixels of a square's rows, and of one more, in turn
  // By column, then by disparity, the largest first.
  std::vector<int16_t> columns_;                 ///< costs of pixels above one another
  std::vector<int16_t> first_square_, squares_;  ///< costs of squares
  std::vector<int16_t> sums_;                    ///< costs along all paths
  PathCosts from_left_, from_right_;             ///< of two pixels in turn
  PathCosts from_above_, from_above_before_;     ///< of this row, and of the one above
  PathCosts from_above_left_, from_above_right_;
  std::vector<Winner> winners_;
  std::vector<int16_t> right_costs_, right_disparities_;  ///< the best match so far of each pixel of the right image
  cv::Mat found_;
};

}  // namespace hedgehop::vision::stereo
