#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::vision::flow {

/// Weights of bilinear interpolation between four pixels, 14 fractional bits, whose sum is 1.
struct CornerWeights {
  /// @param part  position between the pixels, 0..1 in each direction.
  explicit CornerWeights(const cv::Point2f& part);
  int16_t top_left, top_right, bottom_left, bottom_right;
};

/// Rows of the tracking window of a corner and the buffers of its interpolated values. Of the pixels and gradients, one
/// more row is read and up to kLanes more values of each row.
struct CornerRows {
  static constexpr int kLanes = 8;

  const uint8_t* pixels;
  ptrdiff_t pixel_step;
  const int16_t* gradients;  ///< x and y in turn; for load_rows()
  ptrdiff_t gradient_step;
  int16_t *grey, *gradient_x, *gradient_y;  ///< `window` rows of `stride` values; grey x 32
  int window, stride;                       ///< a multiple of kLanes, at least `window`
};

/// Interpolates grey levels and gradients into the buffers; gradients beyond the window are zero. Returns the sums of
/// the gradients' products: x x, x y and y y.
std::array<int64_t, 3> load_rows(const CornerRows& rows, const CornerWeights& weights);

/// Returns the sums of the differences between the interpolated pixels and the grey levels in the buffer, times the
/// gradients in x and in y.
std::array<int64_t, 2> mismatch_of_rows(const CornerRows& rows, const CornerWeights& weights);

}  // namespace hedgehop::vision::flow
