#include "vision/stereo/stereo_matcher.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/fields/bounds.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

void check(const StereoMatcherConfig& c) {
  const auto need = [](bool holds, const std::string& fault) {
    if (!holds) throw std::invalid_argument(fault);
  };
  fields::require_bounds(c);
  need(c.disparities_px % 16 == 0, "disparities: " + std::to_string(c.disparities_px) + " is not a multiple of 16");
  need(c.block_px % 2 == 1, "block: " + std::to_string(c.block_px) + " is not odd");
  need(c.method == StereoMatcherConfig::Method::semi_global || c.block_px >= 5,
       "block: the block matcher takes squares of 5 px or more, got " + std::to_string(c.block_px));
}

cv::Ptr<cv::StereoMatcher> make(const StereoMatcherConfig& c) {
  if (c.method == StereoMatcherConfig::Method::block) {
    const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(c.disparities_px, c.block_px);
    matcher->setUniquenessRatio(c.uniqueness_percent);
    matcher->setTextureThreshold(c.texture);
    matcher->setDisp12MaxDiff(c.left_right_px);
    return matcher;
  }
  // OpenCV's own rule of thumb for the penalties of a step of one and of more.
  const int area = c.block_px * c.block_px;
  return cv::StereoSGBM::create(0, c.disparities_px, c.block_px, 8 * area, 32 * area, c.left_right_px,
                                /*preFilterCap=*/31, c.uniqueness_percent, 0, 0, cv::StereoSGBM::MODE_SGBM);
}

/// Drops what would lie left of the right image's edge.
void drop_outside(cv::Mat& disparity16, int columns) {
  for (int v = 0; v < disparity16.rows; ++v) {
    auto* const d = disparity16.ptr<int16_t>(v);
    for (int u = 0; u < columns; ++u) {
      if (d[u] > kDisparityUnits * u) d[u] = kNoDisparity;
    }
  }
}

}  // namespace

struct StereoMatcher::Engine {
  cv::Ptr<cv::StereoMatcher> matcher;
  int margin_px;
  cv::Mat left, right, disparity16;  ///< with a margin on the left
};

StereoMatcher::StereoMatcher(const StereoMatcherConfig& config) {
  check(config);
  engine_ = std::make_unique<Engine>(Engine{make(config), config.disparities_px, {}, {}, {}});
}
StereoMatcher::StereoMatcher(StereoMatcher&&) noexcept = default;
StereoMatcher& StereoMatcher::operator=(StereoMatcher&&) noexcept = default;
StereoMatcher::~StereoMatcher() = default;

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  if (left.type() != CV_8UC1 || right.type() != CV_8UC1 || left.size() != right.size()) {
    throw std::invalid_argument("a stereo pair must be two CV_8UC1 images of one size");
  }
  // OpenCV leaves out as many columns on the left as it searches disparities. Before a margin it answers for them, too.
  Engine& e = *engine_;
  for (const auto& [image, wide] : {std::pair(&left, &e.left), std::pair(&right, &e.right)}) {
    cv::copyMakeBorder(*image, *wide, 0, 0, e.margin_px, 0, cv::BORDER_REPLICATE);
  }
  e.matcher->compute(e.left, e.right, e.disparity16);
  e.disparity16.colRange(e.margin_px, e.disparity16.cols).copyTo(disparity16);
  disparity16.setTo(kNoDisparity, disparity16 < 0);
  drop_outside(disparity16, std::min(e.margin_px, disparity16.cols));
}

}  // namespace hedgehop::vision::stereo
