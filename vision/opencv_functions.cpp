#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <opencv2/video/tracking.hpp>

#include "vision/opencv_library.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::vision {
namespace {

class OpenCvFunctions final : public OpenCvLibrary {
 public:
  void pyramid(const cv::Mat& image, cv::Size window_px, int max_level, std::vector<cv::Mat>& levels) const override {
    cv::buildOpticalFlowPyramid(image, levels, window_px, max_level);
  }

  void track(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& points,
             std::vector<cv::Point2f>& moved, std::vector<uint8_t>& found) const override {
    cv::calcOpticalFlowPyrLK(from, to, points, moved, found, cv::noArray());
  }

  cv::Ptr<cv::StereoMatcher> semi_global(const stereo::StereoMatcherConfig& config) const override {
    // OpenCV's recommended penalties for disparity changes of one and of more than one.
    const int area = config.block_px * config.block_px;
    return cv::StereoSGBM::create(0, config.disparities_px, config.block_px, 8 * area, 32 * area, config.left_right_px,
                                  /*preFilterCap=*/31, config.uniqueness_percent, 0, 0, cv::StereoSGBM::MODE_SGBM);
  }

  cv::Ptr<cv::StereoMatcher> block(const stereo::StereoMatcherConfig& config) const override {
    const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(config.disparities_px, config.block_px);
    matcher->setUniquenessRatio(config.uniqueness_percent);
    matcher->setTextureThreshold(config.texture);
    matcher->setDisp12MaxDiff(config.left_right_px);
    return matcher;
  }
};

}  // namespace
}  // namespace hedgehop::vision

extern "C" const hedgehop::vision::OpenCvLibrary& hedgehop_opencv_library();
const hedgehop::vision::OpenCvLibrary& hedgehop_opencv_library() {
  static const hedgehop::vision::OpenCvFunctions functions;
  return functions;
}
