#include "vision/stereo_matcher.h"

#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <string>

#include "vision/disparity.h"

namespace hedgehop::vision {
namespace {

void check(const StereoMatcherConfig& c) {
  const auto need = [](bool holds, const std::string& fault) {
    if (!holds) throw std::invalid_argument(fault);
  };
  need(c.disparities_px >= 16 && c.disparities_px % 16 == 0,
       "disparities: " + std::to_string(c.disparities_px) + " is not a multiple of 16");
  need(c.block_px >= 1 && c.block_px % 2 == 1, "block: " + std::to_string(c.block_px) + " is not odd");
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

}  // namespace

struct StereoMatcher::Engine {
  cv::Ptr<cv::StereoMatcher> matcher;
};

StereoMatcher::StereoMatcher(const StereoMatcherConfig& config) {
  check(config);
  engine_ = std::make_unique<Engine>(Engine{make(config)});
}
StereoMatcher::StereoMatcher(StereoMatcher&&) noexcept = default;
StereoMatcher& StereoMatcher::operator=(StereoMatcher&&) noexcept = default;
StereoMatcher::~StereoMatcher() = default;

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  if (left.type() != CV_8UC1 || right.type() != CV_8UC1 || left.size() != right.size()) {
    throw std::invalid_argument("a stereo pair must be two CV_8UC1 pictures of one size");
  }
  engine_->matcher->compute(left, right, disparity16);
  disparity16.setTo(kNoDisparity, disparity16 < 0);
}

}  // namespace hedgehop::vision
