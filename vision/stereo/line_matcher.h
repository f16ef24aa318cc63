#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

/// Matches thin lines of a rectified pair, such as branches and poles of a few pixels. In the window of a block matcher
/// the background outweighs them. As in [Zhou2017] sec. 1, edges represent a thin obstacle. Here they are the points of
/// a row that are darker or brighter than both sides:
/// - A point that has a counterpart at the disparity of the block matcher belongs to that surface. Only the others are
///   matched, to the points of the right image that remain, at larger disparities.
/// - A line continues from row to row, while wrong matches of texture scatter. A cell of 8 x 8 px contains a line if
///   most of its rows have matches of one disparity in it or next to it, no other disparity has as many, and the cells
///   above or below continue it.
/// Lines within 18 degrees of the rows cannot be matched. Differs: the paper reconstructs edges from successive images;
/// here the map joins the lines of successive images.
class LineMatcher {
 public:
  static constexpr int kCellPx = 8;
  static constexpr int kDisparities = 32;  ///< from 0; blocks suffice for nearer lines, which are wider

  /// Computes the disparity x 16 of the line in each cell; kNoDisparity without one.
  /// @param left, right  CV_8UC1, of equal size, rectified. @param disparity16  of the left image, from a block
  /// matcher.
  /// @param rows  of pixels to examine. @param lines16  CV_16SC1, rows / kCellPx x columns / kCellPx.
  void match(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity16, const cv::Range& rows,
             cv::Mat& lines16);

 private:
  /// For each disparity, the rows of a cell with matches, one bit per row; for each disparity and the next, their
  /// number.
  using Cell = std::array<uint8_t, kDisparities>;
  /// A pixel that is brighter or darker than both sides, by a contrast in grey levels.
  struct Point {
    int u;
    uint8_t contrast;
    bool bright;
  };

  void find_points(const uint8_t* grey, int width, std::vector<Point>& points);
  void match_row(const int16_t* disparity16, int width, int v);
  bool is_of_surface(const Point& point, int surface16, int width);
  void count_rows(const cv::Range& rows);
  int line16(int row, int col) const;

  size_t index(int row, int col) const { return static_cast<size_t>(row * cols_ + col); }

  int rows_ = 0, cols_ = 0;  ///< of cells
  std::vector<uint8_t> dark_, bright_, smooth_, dark_peaks_, bright_peaks_;
  std::vector<Point> left_, right_;
  std::vector<uint8_t> dark_leftward_, bright_leftward_;  ///< contrasts of the right image, from right to left
  std::vector<uint8_t> of_surface_;                       ///< whether a point of the right image belongs to a surface
  std::vector<Cell> matched_, supported_, continued_;
};

}  // namespace hedgehop::vision::stereo
