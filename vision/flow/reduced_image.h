#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::flow {

/// A smoothed, possibly reduced image of 16-bit values with a rim of zeros, so that samples slightly outside can be
/// read. Rows are padded to a multiple of 8 values.
class ReducedImage {
 public:
  ReducedImage() = default;
  /// @param rim_px  distance outside the image up to which reading is allowed, >= 0.
  ReducedImage(int width, int height, int rim_px);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns the distance outside the image up to which reading is allowed, px.
  int rim() const { return rim_rows_ - 1; }
  /// Returns the number of values from one row to the next, a multiple of 8.
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

/// Returns `width` rounded up to a multiple of 8, the row length of loops over images.
inline int padded(int width) { return (width + 7) / 8 * 8; }

/// Reduces and smooths images. Keeps its scratch space. Images contain grey levels times 2^(bits - 8), rounded.
class ImageReducer {
 public:
  /// @param max_width  maximum width of an image, px.  @param bits  8 to 12.
  ImageReducer(int max_width, int bits);

  /// Smooths with 1 2 1 in both directions at equal size. Edge pixels are repeated.
  void smooth(const cv::Mat& grey, ReducedImage& out);
  void smooth(const ReducedImage& in, ReducedImage& out);
  /// Halves the size (rounded down) with weights 1 3 3 1 in both directions: pixel i is at 2 i + 0.5 of the input.
  void halve(const cv::Mat& grey, ReducedImage& out);
  void halve(const ReducedImage& in, ReducedImage& out);

 private:
  template <class Row>
  void smooth_rows(Row row, int width, int height, int shift, ReducedImage& out);
  template <class Row>
  void halve_rows(Row row, int width, int height, int shift, ReducedImage& out);

  int bits_;
  std::vector<int16_t> line_;  ///< one vertically weighted row with 8 spare values on the left and 16 on the right
};

}  // namespace hedgehop::vision::flow
