#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision {

/// A smoothed picture of 16-bit numbers, possibly reduced, with a rim of zeros so that samples somewhat outside can be
/// read. Rows are padded to a multiple of 8 numbers.
class ReducedPicture {
 public:
  ReducedPicture() = default;
  /// @param rim_px  how far outside the picture reading is allowed, >= 0.
  ReducedPicture(int width, int height, int rim_px);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Numbers from one row to the next, a multiple of 8.
  int stride() const { return stride_; }
  int16_t* row(int y) { return data_.data() + offset(y); }
  const int16_t* row(int y) const { return data_.data() + offset(y); }

 private:
  size_t offset(int y) const {
    return static_cast<size_t>(rim_rows_ + y) * static_cast<size_t>(stride_) + static_cast<size_t>(rim_cols_);
  }

  int width_ = 0, height_ = 0, rim_rows_ = 0, rim_cols_ = 0, stride_ = 0;
  std::vector<int16_t> data_;
};

/// `width` rounded up to a multiple of 8: the row length that the loops over pictures work on.
inline int padded(int width) { return (width + 7) / 8 * 8; }

/// Reduces and smooths pictures; its rows of scratch space are made once.
/// Every picture holds grey levels times 2^(bits - 8), rounded.
class PictureReducer {
 public:
  /// @param max_width  of any picture given, px.  @param bits  8 to 12.
  PictureReducer(int max_width, int bits);

  /// Same size, binomial 1 2 1 smoothing both ways. Edge pixels are repeated.
  void smooth(const cv::Mat& grey, ReducedPicture& out);
  void smooth(const ReducedPicture& in, ReducedPicture& out);
  /// Half the size (rounded down), weights 1 3 3 1 both ways: pixel i lies at 2 i + 0.5 of the input.
  void halve(const cv::Mat& grey, ReducedPicture& out);
  void halve(const ReducedPicture& in, ReducedPicture& out);

 private:
  template <class Row>
  void smooth_rows(Row row, int width, int height, int shift, ReducedPicture& out);
  template <class Row>
  void halve_rows(Row row, int width, int height, int shift, ReducedPicture& out);

  int bits_;
  std::vector<int16_t> line_;  ///< one vertically weighted row, 8 numbers of room on the left and 16 on the right
};

}  // namespace hedgehop::vision
