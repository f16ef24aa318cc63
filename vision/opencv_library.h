#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace cv {
class StereoMatcher;
}

namespace hedgehop::vision {

namespace stereo {
struct StereoMatcherConfig;
}

/// The functions of OpenCV's modules video and calib3d that Hedgehop uses. The implementation is in
/// libhedgehop_opencv.so, which is loaded at the first use, because these modules take as long to load as all other
/// libraries.
class OpenCvLibrary {
 public:
  virtual ~OpenCvLibrary() = default;
  /// cv::buildOpticalFlowPyramid, with derivatives.
  virtual void pyramid(const cv::Mat& image, cv::Size window_px, int max_level, std::vector<cv::Mat>& levels) const = 0;
  /// cv::calcOpticalFlowPyrLK with OpenCV's default window and levels. @param[out] found  not 0: the point was found.
  virtual void track(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& points,
                     std::vector<cv::Point2f>& moved, std::vector<uint8_t>& found) const = 0;
  virtual cv::Ptr<cv::StereoMatcher> block(const stereo::StereoMatcherConfig& config) const = 0;
  virtual cv::Ptr<cv::StereoMatcher> semi_global(const stereo::StereoMatcherConfig& config) const = 0;
};

/// Returns the library. The first call loads it. Throws std::runtime_error if it cannot be loaded.
const OpenCvLibrary& opencv_library();

/// The function of the library.
using GetOpenCvLibrary = const OpenCvLibrary&();
constexpr const char* kOpenCvLibrary = "libhedgehop_opencv.so";
constexpr const char* kGetOpenCvLibrary = "hedgehop_opencv_library";

}  // namespace hedgehop::vision
