#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::flow {

/// A smoothed image of 16-bit numbers, possibly reduced, with a rim of zeros so that samples somewhat outside can be
/// read. Rows are padded to a multiple of 8 numbers.
class ReducedImage {
 public:
  ReducedImage() = default;
  /// @param rim_px  how far outside the image reading is allowed, >= 0.
  ReducedImage(int width, int height, int rim_px);

  int width() const { return width_; }
  int height() const { return height_; }
  /// How far outside the image reading is allowed, px.
  int rim() const { return rim_rows_ - 1; }
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

/// `width` rounded up to a multiple of 8: the row length that the loops over images work on.
inline int padded(int width) { return (width + 7) / 8 * 8; }

/// Reduces and smooths images; its rows of scratch space are made once.
/// Every image holds grey levels times 2^(bits - 8), rounded.
class ImageReducer {
 public:
  /// @param max_width  of any image given, px.  @param bits  8 to 12.
  ImageReducer(int max_width, int bits);

  /// Same size, binomial 1 2 1 smoothing both ways. Edge pixels are repeated.
  void smooth(const cv::Mat& grey, ReducedImage& out);
  void smooth(const ReducedImage& in, ReducedImage& out);
  /// Half the size (rounded down), weights 1 3 3 1 both ways: pixel i lies at 2 i + 0.5 of the input.
  void halve(const cv::Mat& grey, ReducedImage& out);
  void halve(const ReducedImage& in, ReducedImage& out);

 private:
  template <class Row>
  void smooth_rows(Row row, int width, int height, int shift, ReducedImage& out);
  template <class Row>
  void halve_rows(Row row, int width, int height, int shift, ReducedImage& out);

  int bits_;
  std::vector<int16_t> line_;  ///< one vertically weighted row, 8 numbers of room on the left and 16 on the right
};

}  // namespace hedgehop::vision::flow
