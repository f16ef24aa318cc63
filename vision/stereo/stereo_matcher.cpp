#include "vision/stereo/stereo_matcher.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
#include "vision/opencv_library.h"
#include "vision/stereo/block_matcher.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/semi_global_matcher.h"

namespace hedgehop::vision::stereo {
namespace {

void check(const StereoMatcherConfig& c) {
  const auto need = [](bool holds, const char* key, const std::string& message) {
    if (!holds) throw fields::InvalidField(key, message);
  };
  fields::require_bounds(c);
  need(c.disparities_px % 16 == 0, "disparities", std::to_string(c.disparities_px) + " is not a multiple of 16");
  need(c.block_px % 2 == 1, "block", std::to_string(c.block_px) + " is not odd");
  need(c.method == StereoMatcherConfig::Method::semi_global || c.block_px >= 5, "block",
       "the block matcher takes squares of 5 px or more, got " + std::to_string(c.block_px));
}

/// Returns OpenCV's matcher; null if ours gives equal results in less time.
cv::Ptr<cv::StereoMatcher> make(const StereoMatcherConfig& c) {
  if (c.method == StereoMatcherConfig::Method::block) {
    return c.block_px <= BlockMatcher::kMaxBlockPx ? nullptr : opencv_block(c);
  }
  return c.block_px <= SemiGlobalMatcher::kMaxBlockPx ? nullptr : opencv_semi_global(c);
}

/// Copies the disparities without the margin. Disparities that point outside the right image become unknown.
void copy_known(const cv::Mat& wide16, int margin_px, cv::Mat& disparity16) {
  disparity16.create(wide16.rows, wide16.cols - margin_px, CV_16SC1);
  for (int v = 0; v < disparity16.rows; ++v) {
    const auto* const from = wide16.ptr<int16_t>(v) + margin_px;
    auto* const to = disparity16.ptr<int16_t>(v);
    for (int u = 0; u < disparity16.cols; ++u) to[u] = std::max(from[u], kNoDisparity);
    for (int u = 0; u < std::min(margin_px, disparity16.cols); ++u) {
      if (to[u] > kDisparityUnits * u) to[u] = kNoDisparity;
    }
  }
}

}  // namespace

cv::Ptr<cv::StereoMatcher> opencv_semi_global(const StereoMatcherConfig& config) {
  return opencv_library().semi_global(config);
}

cv::Ptr<cv::StereoMatcher> opencv_block(const StereoMatcherConfig& config) { return opencv_library().block(config); }

struct StereoMatcher::Engine {
  StereoMatcherConfig config;
  cv::Ptr<cv::StereoMatcher> opencv;
  std::optional<SemiGlobalMatcher> semi_global;  ///< for the current image size
  std::optional<BlockMatcher> block;             ///< likewise
  cv::Mat left, right, disparity16;              ///< with a margin on the left

  void compute() {
    if (opencv) return opencv->compute(left, right, disparity16);
    if (config.method == StereoMatcherConfig::Method::block) {
      return compute_by(block, BlockConfig{config.disparities_px, config.block_px, config.uniqueness_percent,
                                           config.texture, config.left_right_px});
    }
    compute_by(semi_global, SemiGlobalConfig{config.disparities_px, config.block_px, config.uniqueness_percent,
                                             std::max(config.left_right_px, 1)});
  }

  template <class Matcher, class Config>
  void compute_by(std::optional<Matcher>& matcher, const Config& its_config) {
    if (!matcher || matcher->size() != left.size()) matcher.emplace(its_config, left.size());
    matcher->compute(left, right, disparity16);
  }
};

StereoMatcher::StereoMatcher(const StereoMatcherConfig& config) {
  check(config);
  engine_ = std::make_unique<Engine>(Engine{config, make(config), {}, {}, {}, {}, {}});
}
StereoMatcher::StereoMatcher(StereoMatcher&&) noexcept = default;
StereoMatcher& StereoMatcher::operator=(StereoMatcher&&) noexcept = default;
StereoMatcher::~StereoMatcher() = default;

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  if (left.type() != CV_8UC1 || right.type() != CV_8UC1 || left.size() != right.size()) {
    throw std::invalid_argument("a stereo pair must be two CV_8UC1 images of one size");
  }
  // OpenCV computes no disparities for as many left columns as there are disparities. A margin of that width avoids
  // this.
  Engine& e = *engine_;
  const int margin_px = e.config.disparities_px;
  for (const auto& [image, wide] : {std::pair(&left, &e.left), std::pair(&right, &e.right)}) {
    cv::copyMakeBorder(*image, *wide, 0, 0, margin_px, 0, cv::BORDER_REPLICATE);
  }
  e.compute();
  copy_known(e.disparity16, margin_px, disparity16);
}

}  // namespace hedgehop::vision::stereo
