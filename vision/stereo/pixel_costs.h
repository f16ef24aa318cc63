#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

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

}  // namespace hedgehop::vision::stereo
