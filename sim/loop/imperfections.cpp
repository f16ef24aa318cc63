#include "sim/loop/imperfections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/libm/random.h"
#include "sim/loop/pixel_levels.h"

namespace hedgehop::sim {
namespace {

constexpr double kWhite = 255.0;

/// Uniform in [0, 1).
double draw(uint64_t seed, int64_t frame, std::string_view what) {
  return unit_interval(stream_seed(stream_seed(seed, what) + static_cast<uint64_t>(frame), what));
}

}  // namespace

Imperfections::Imperfections(const ImperfectionsConfig& config, double period_s, uint64_t seed, double focal_px)
    : config_(config), period_s_(period_s), seed_(seed), focal_px_(focal_px), gain_(std::exp2(config.exposure_stops)) {}

Imperfections::FrameFault Imperfections::frame_fault(int64_t frame) const {
  if (draw(seed_, frame, "drop") < config_.drop) return FrameFault::dropped;
  if (draw(seed_, frame, "freeze") < config_.freeze) return FrameFault::frozen;
  if (draw(seed_, frame, "black") < config_.black) return FrameFault::black;
  return FrameFault::none;
}

void Imperfections::apply(int64_t frame, cv::Mat& image) const {
  if (image.type() == CV_32FC1 && config_.disparity_noise_px > 0.0) return apply_to_depth(frame, image);
  const bool noisy = config_.full_well > 0.0 || config_.read_noise > 0.0;
  const bool exposed = config_.exposure_stops != 0.0 || config_.auto_exposure_s > 0.0;
  if (image.depth() != CV_8U || (!noisy && !exposed && !is_uneven())) return;

  const cv::Mat response = is_uneven() ? response_for(image) : cv::Mat();
  std::optional<LevelNoise> noise;
  if (noisy) {
    // Photon counts have a Poisson distribution: the variance is the mean.
    noise = {.seed = stream_seed(seed_ + static_cast<uint64_t>(frame), "noise"),
             .variance_per_level = config_.full_well > 0.0 ? kWhite / config_.full_well : 0.0,
             .read_variance = config_.read_noise * config_.read_noise};
  }
  read_out(response, gain_, noise, image);
}

void Imperfections::apply_to_depth(int64_t frame, cv::Mat& depth_m) const {
  const double disparity_m_px = focal_px_ * ImperfectionsConfig::kBaselineM;  // disparity times depth
  cv::divide(disparity_m_px, depth_m, levels_);                               // 0 for the sky, NaN stays NaN
  noise_.create(levels_.size(), levels_.type());
  fill_normal(stream_seed(seed_ + static_cast<uint64_t>(frame), "disparity"), noise_);
  noise_ *= config_.disparity_noise_px;
  levels_ += noise_;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float disparity_px = levels_.at<float>(v, u);
      float& z_m = depth_m.at<float>(v, u);
      if (disparity_px > 0.0F) z_m = static_cast<float>(disparity_m_px / disparity_px);
      if (disparity_px <= 0.0F) z_m = std::numeric_limits<float>::infinity();
    }
  }
}

/// Returns the response of each pixel to light: the transmittance of the lens times the pixel's gain.
const cv::Mat& Imperfections::response_for(const cv::Mat& image) const {
  const cv::Size size = image.size();
  const int type = CV_32FC(image.channels());
  if (response_.size() == size && response_.type() == type) return response_;
  cv::Mat share(size, CV_32F);
  const double center_u = 0.5 * (size.width - 1), center_v = 0.5 * (size.height - 1);
  const double corner2 = std::max(1.0, center_u * center_u + center_v * center_v);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double du = u - center_u, dv = v - center_v;
      share.at<float>(v, u) = static_cast<float>(1.0 - config_.vignetting * (du * du + dv * dv) / corner2);
    }
  }
  cv::merge(std::vector<cv::Mat>(static_cast<size_t>(image.channels()), share), response_);
  if (config_.fixed_pattern > 0.0) {
    cv::Mat gain(size, type);
    fill_normal(stream_seed(seed_, "fixed_pattern"), gain);
    // Two steps, because convertTo() with a term rounds once on processors with FMA.
    gain.convertTo(gain, CV_32F, config_.fixed_pattern);
    cv::add(gain, cv::Scalar::all(1.0), gain);
    cv::multiply(response_, gain, response_);
  }
  return response_;
}

/// Applies a first-order lag of the logarithm of the gain toward the gain for a mid-grey mean.
void Imperfections::expose(const cv::Mat& image) {
  if (image.depth() != CV_8U || config_.auto_exposure_s <= 0.0) return;
  image.convertTo(levels_, CV_32F);
  if (is_uneven()) cv::multiply(levels_, response_for(image), levels_);
  const cv::Scalar sums = cv::mean(levels_);
  double mean = 0.0;
  for (int channel = 0; channel < image.channels(); ++channel) mean += sums[channel] / image.channels();
  constexpr double kMinMean = 1.0;  // level; a darker image does not increase the gain further
  const double target = 0.5 * kWhite / std::max(kMinMean, mean);
  gain_ *= std::pow(target / gain_, 1.0 - std::exp(-period_s_ / config_.auto_exposure_s));
}

void blank(cv::Mat& image) {
  const bool whole_numbers = image.depth() < CV_32F;
  image.setTo(whole_numbers ? cv::Scalar::all(0) : cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace hedgehop::sim
