#include "vision/corridor/approach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "sim/fields/bounds.h"

namespace hedgehop::vision::corridor {
namespace {

constexpr int kStepPx = 3;      // between samples
constexpr int kMarginPx = 24;   // for the displacement of samples
constexpr double kGreys = 2.0;  // minimum noise of images, grey levels, also assumed for smooth surfaces
constexpr int kSweeps = 6;

/// Returns the grey level at `p` by bilinear interpolation. @param p  at least 1 px inside the image.
double grey(const cv::Mat& image, const Eigen::Vector2d& p) {
  const int u = static_cast<int>(p.x()), v = static_cast<int>(p.y());
  const double a = p.x() - u, b = p.y() - v;
  const float *above = image.ptr<float>(v) + u, *below = image.ptr<float>(v + 1) + u;
  return (1 - b) * ((1 - a) * above[0] + a * above[1]) + b * ((1 - a) * below[0] + a * below[1]);
}

cv::Mat smooth(const cv::Mat& image, const cv::Rect& box, double sigma_px) {
  cv::Mat result;
  image(box).convertTo(result, CV_32F);
  cv::GaussianBlur(result, result, {}, sigma_px, sigma_px, cv::BORDER_REPLICATE);
  return result;
}

}  // namespace

/// One Gauss-Newton step.
struct ApproachMeter::Fit {
  double change_per_s = 0.0, sigma_per_s = 0.0;
};

ApproachMeter::ApproachMeter(const ApproachConfig& config, const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                             const CorridorRegions& regions, int rim_px)
    : config_(config), camera_(camera) {
  fields::require_bounds(config);
  CorridorRegions narrow = regions;
  narrow.ahead_rad = config.half_width_rad;
  const cv::Mat mask = region_masks(camera, X_BC, narrow, rim_px)[kAhead];
  box_ = cv::boundingRect(mask);
  for (int v = box_.y; v < box_.br().y; v += kStepPx) {
    for (int u = box_.x; u < box_.br().x; u += kStepPx) {
      if (!mask.at<uint8_t>(v, u)) continue;
      if (const auto ray_C = camera.unit_ray({u, v})) samples_.push_back({{u, v}, *ray_C});
    }
  }
  if (samples_.empty()) return;
  box_ = cv::Rect(box_.tl() - cv::Point(kMarginPx, kMarginPx), box_.size() + cv::Size(2 * kMarginPx, 2 * kMarginPx)) &
         cv::Rect(0, 0, camera.width_px, camera.height_px);
}

std::optional<ApproachMeter::Fit> ApproachMeter::fit(const cv::Mat& older, const cv::Mat& newer,
                                                     const CameraMotion& motion, double rate_per_s) const {
  const Eigen::Vector3d travel_C = motion.R_HC1.transpose() * motion.traveled_H.normalized();
  const Eigen::Matrix3d R_C2C1 = motion.R_HC2.transpose() * motion.R_HC1;
  const Eigen::Vector2d corner_px(box_.x, box_.y);
  const cv::Rect2d inside(1.0, 1.0, box_.width - 3.0, box_.height - 3.0);
  // A point at depth Z along the travel keeps its lateral position and approaches by rate * dt * Z.
  constexpr double kSmallPerS = 0.05;
  std::vector<Eigen::Vector3d> points_C;  // of each sample at the rate and at a slightly larger one
  std::vector<const Sample*> samples;
  for (const Sample& sample : samples_) {
    const double along = sample.ray_C.dot(travel_C);
    if (along <= 0.1) continue;
    samples.push_back(&sample);
    for (const double rate : {rate_per_s, rate_per_s + kSmallPerS}) {
      points_C.emplace_back(R_C2C1 * (sample.ray_C / along - motion.dt_s * rate * travel_C));
    }
  }
  const std::vector<Eigen::Vector2d> pixels = camera_.project_each(points_C);
  double jj = 0.0, jr = 0.0, rr = 0.0;
  int count = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector2d &at = pixels[2 * i], &on = pixels[2 * i + 1];
    if (std::isnan(at.x()) || std::isnan(on.x())) continue;
    const Eigen::Vector2d p = at - corner_px, slide = (on - at) / kSmallPerS;
    if (!inside.contains({p.x(), p.y()})) continue;
    const double right = 0.5 * (grey(newer, p + Eigen::Vector2d(1, 0)) - grey(newer, p - Eigen::Vector2d(1, 0)));
    const double below = 0.5 * (grey(newer, p + Eigen::Vector2d(0, 1)) - grey(newer, p - Eigen::Vector2d(0, 1)));
    const double j = right * slide.x() + below * slide.y();
    const double r = grey(newer, p) - older.at<float>(samples[i]->pixel - box_.tl());
    jj += j * j, jr += j * r, rr += r * r, ++count;
  }
  if (count < 30 || jj == 0.0) return std::nullopt;
  const double left = std::max(0.0, rr - jr * jr / jj) / count;
  // Neighbors in a smoothed image are correlated. This number of samples counts as one.
  constexpr double kAlike = 8.0;
  return Fit{-jr / jj, std::sqrt(kAlike * (left + kGreys * kGreys) / jj)};
}

std::optional<ApproachRate> ApproachMeter::measure(const cv::Mat& older, const cv::Mat& newer,
                                                   const CameraMotion& motion) const {
  if (samples_.empty() || motion.traveled_H.norm() == 0.0) return std::nullopt;
  ApproachRate approach;
  for (const double sigma_px : {5.0, 2.0}) {
    const cv::Mat from = smooth(older, box_, sigma_px), to = smooth(newer, box_, sigma_px);
    for (int i = 0; i < kSweeps; ++i) {
      const auto step = fit(from, to, motion, approach.rate_per_s);
      if (!step) return std::nullopt;
      approach.rate_per_s += step->change_per_s;
      approach.sigma_per_s = step->sigma_per_s;
      // The wall is never behind the camera.
      approach.rate_per_s = std::clamp(approach.rate_per_s, -0.5 / motion.dt_s, 0.5 / motion.dt_s);
      constexpr double kDonePerS = 1e-3;
      if (std::abs(step->change_per_s) < kDonePerS) break;
    }
  }
  if (approach.sigma_per_s > config_.sigma_per_s) return std::nullopt;
  return approach;
}

}  // namespace hedgehop::vision::corridor
