#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace hedgehop::vision::flow {

/// Follows corners from one image into another by pyramidal Lucas-Kanade, as OpenCV's calcOpticalFlowPyrLK does with 30
/// iterations at most down to steps of 0.005 px. Sums are whole numbers, so that they do not depend on the order in
/// which a processor adds: places differ from OpenCV's by what it rounds, 1e-5 px or, seldom, a last step.
class CornerTracker {
 public:
  /// @param window_px  side of the square that is compared, odd. @param levels  of the pyramids that are used, >= 1.
  CornerTracker(int window_px, int levels);

  /// @param from, to  pyramids of images with their gradients, as cv::buildOpticalFlowPyramid makes them with windows
  /// of `window_px`. @param guess  where to look first; without one, where it was.
  /// @return where a corner of `from` is in `to`; nothing if it is lost.
  std::optional<cv::Point2f> follow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                    const cv::Point2f& corner, const std::optional<cv::Point2f>& guess = {});

 private:
  /// Sums of the gradients' products.
  struct Normal {
    float xx = 0.0F, xy = 0.0F, yy = 0.0F, determinant = 0.0F;
    bool solvable = false;
  };
  Normal cut_out(const cv::Mat& image, const cv::Mat& gradients, const cv::Point2f& corner);
  template <class Number>
  struct Rows {
    const Number* first;
    ptrdiff_t step;
  };
  template <class Number>
  Rows<Number> rows_at(const cv::Mat& image, const cv::Point& at, std::vector<Number>& spare) const;
  cv::Point2f mismatch(const cv::Mat& image, const cv::Point& at, const cv::Point2f& part);
  bool search(const cv::Mat& image, const Normal& normal, cv::Point2f& place);

  int window_, levels_;
  int stride_, rows_at_once_;  ///< of the rows below: numbers, and how many may be summed in 32 bits
  std::vector<int16_t> grey_, gradient_x_, gradient_y_;  ///< of the square about the corner, grey x 32
  std::vector<uint8_t> pixels_;                          ///< copies near an image's end
  std::vector<int16_t> gradients_;
};

}  // namespace hedgehop::vision::flow
