#include "vision/stereo/depth_pyramid.h"

#include <algorithm>
#include <stdexcept>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

void halve(const cv::Mat& fine, cv::Mat& coarse) {
  coarse.create(fine.rows / 2, fine.cols / 2, CV_16SC1);
  for (int v = 0; v < coarse.rows; ++v) {
    const auto* const upper = fine.ptr<int16_t>(2 * v);
    const auto* const lower = fine.ptr<int16_t>(2 * v + 1);
    auto* const out = coarse.ptr<int16_t>(v);
    for (int u = 0; u < coarse.cols; ++u) {
      out[u] = std::max(std::max(upper[2 * u], upper[2 * u + 1]), std::max(lower[2 * u], lower[2 * u + 1]));
    }
  }
}

}  // namespace

void DepthPyramid::build(const cv::Mat& disparity16, int top) {
  if (disparity16.type() != CV_16SC1) throw std::invalid_argument("a disparity image must be CV_16SC1");
  if (top < 0 || top > 15) throw std::invalid_argument("a pyramid's coarsest level lies in [0, 15]");
  image_ = disparity16.size();
  levels_.resize(static_cast<size_t>(top) + 1);
  const int block = 1 << top;
  const auto whole_blocks = [&](int pixels) { return (pixels + block - 1) / block * block; };
  levels_[0].create(whole_blocks(image_.height), whole_blocks(image_.width), CV_16SC1);
  levels_[0].setTo(kNoDisparity);
  disparity16.copyTo(levels_[0](cv::Rect({}, image_)));
  for (size_t n = 1; n < levels_.size(); ++n) halve(levels_[n - 1], levels_[n]);
}

}  // namespace hedgehop::vision::stereo
