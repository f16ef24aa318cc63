#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/flow/corner_window.h"

namespace hedgehop::vision::flow {

/// Tracks corners from one image to another by pyramidal Lucas-Kanade, like OpenCV's calcOpticalFlowPyrLK with at most
/// 30 iterations and a minimum step of 0.005 px. Sums are integers, so that they do not depend on the order of
/// addition. Results differ from OpenCV's by its rounding errors: 1e-5 px or, rarely, one last step.
class CornerTracker {
 public:
  /// @param window_px  side of the tracking window, odd. @param levels  number of pyramid levels used, >= 1.
  CornerTracker(int window_px, int levels);

  /// Returns the position in `to` of a corner of `from`; std::nullopt if it is lost.
  /// @param from, to  pyramids with gradients, as cv::buildOpticalFlowPyramid makes them with windows of `window_px`.
  /// @param guess  initial position in `to`; by default the position in `from`.
  std::optional<cv::Point2f> track(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                   const cv::Point2f& corner, const std::optional<cv::Point2f>& guess = {});

 private:
  /// Normal matrix: sums of the gradients' products.
  struct NormalMatrix {
    float xx = 0.0F, xy = 0.0F, yy = 0.0F, determinant = 0.0F;
    bool solvable = false;
  };
  NormalMatrix load_window(const cv::Mat& image, const cv::Mat& gradients, const cv::Point2f& corner);
  template <class Number>
  struct Rows {
    const Number* first;
    ptrdiff_t step;
  };
  template <class Number>
  Rows<Number> rows_at(const cv::Mat& image, const cv::Point& at, std::vector<Number>& spare) const;
  CornerRows window_rows(const Rows<uint8_t>& greys);
  cv::Point2f mismatch(const cv::Mat& image, const cv::Point& at, const cv::Point2f& part);
  bool search(const cv::Mat& image, const NormalMatrix& normal, cv::Point2f& place);

  int window_, levels_;
  int stride_;                                           ///< values per row of the buffers below
  std::vector<int16_t> grey_, gradient_x_, gradient_y_;  ///< of the window around the corner; grey x 32
  std::vector<uint8_t> pixels_;                          ///< copies near the right border of an image
  std::vector<int16_t> gradients_;
};

}  // namespace hedgehop::vision::flow
