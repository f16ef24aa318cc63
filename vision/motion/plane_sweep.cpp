#include "vision/motion/plane_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "vision/motion/cost_rows.h"

namespace hedgehop::vision::motion {
namespace {

constexpr int kDetail = 63;              // limit of the difference from the local mean, grey levels
constexpr int kLocalPx = 15;             // side of the area of this mean
constexpr double kMaxStepPx = 2.0;       // displacement from plane to plane in the image corner
constexpr double kOtherPx = 1.5;         // displacement from which another depth is a different match
constexpr double kInterpolatedPx = 0.8;  // displacement to the costs on both sides of the minimum
constexpr int kUniquePercent = 10;       // required margin of the minimum over different matches
constexpr double kMaxMatchPx = 0.3;      // maximum error of a match by noise; beyond it the bound is too small

/// Pixels and weights of linear interpolation along one axis; -1 outside the image. Weights in 32nds.
struct Axis {
  std::vector<int> first, weight;
};

Axis sample_axis(int size, double center, double scale, double shift) {
  Axis axis;
  for (int i = 0; i < size; ++i) {
    const double at = center + scale * (i - center - shift);
    const int in_units = static_cast<int>(std::floor(kUnit * at + 0.5));
    const int first = std::min(in_units >> 5, size - 2);
    const bool inside = in_units >= 0 && in_units <= kUnit * (size - 1);
    axis.first.push_back(inside ? first : -1);
    axis.weight.push_back(inside ? in_units - kUnit * first : 0);
  }
  return axis;
}

cv::Mat detail_of(const cv::Mat& image) {
  cv::Mat mean, detail;
  cv::boxFilter(image, mean, CV_8U, {kLocalPx, kLocalPx});
  cv::subtract(image, mean, detail, cv::noArray(), CV_16S);
  cv::min(cv::max(detail, -kDetail), kDetail, detail);
  detail.convertTo(detail, CV_8U, 1.0, kDetail);
  return detail;
}

}  // namespace

PlaneSweep::PlaneSweep(const camera::PinholeCamera& camera, const MatchNoise& noise)
    : width_(camera.width_px / kReduction),
      height_(camera.height_px / kReduction),
      focal_(camera.focal_x_px / kReduction),
      center_u_((camera.center_u_px - 0.5) / kReduction),
      center_v_((camera.center_v_px - 0.5) / kReduction),
      noise_(noise) {
  constexpr int kSmallestPx = 64;
  if (camera.width_px % kReduction != 0 || camera.height_px % kReduction != 0 ||
      std::min(camera.width_px, camera.height_px) < kSmallestPx || camera.focal_x_px != camera.focal_y_px) {
    throw std::invalid_argument("depth from motion needs an image of even size, at least 64 px, and square pixels");
  }
}

cv::Mat PlaneSweep::smooth(const cv::Mat& grey) {
  cv::Mat smoothed;
  cv::boxFilter(grey, smoothed, CV_8U, {kReduction, kReduction}, {0, 0});
  return smoothed;
}

double PlaneSweep::spacing_per_m(const Eigen::Vector3d& p_CCk) const {
  double most_px = 1e-9;
  for (const int u : {0, width_ - 1}) {
    for (const int v : {0, height_ - 1}) {
      most_px = std::max(most_px, displacement(ray_C(u, v), p_CCk, 0.0, focal_).norm());
    }
  }
  constexpr double kMaxApproach = 0.5;  // of a camera that flies backward, relative to the depth
  const double nearest_per_m = p_CCk.z() > 0.0 ? kMaxApproach / p_CCk.z() : HUGE_VAL;
  return std::min(kMaxStepPx / most_px, nearest_per_m / kPlanes);
}

/// Computes the reduced image that Ck would have taken with the orientation of C.
/// @param valid  CV_8UC1, 0 at pixels that Ck did not show; they repeat its border.
void PlaneSweep::derotate(const cv::Mat& key, const Eigen::Matrix3d& R_CCk, cv::Mat& derotated, cv::Mat& valid) const {
  derotated.create(height_, width_, CV_8UC1);
  valid.create(height_, width_, CV_8UC1);
  const Eigen::Matrix3d R_CkC = R_CCk.transpose();
  const double last_u = key.cols - 1.001, last_v = key.rows - 1.001;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const Eigen::Vector3d ray_Ck = R_CkC * ray_C(u, v);
      const double scale = focal_ / std::max(ray_Ck.z(), 1e-3);
      const double key_u = kReduction * (center_u_ + scale * ray_Ck.x());
      const double key_v = kReduction * (center_v_ + scale * ray_Ck.y());
      const double at_u = std::clamp(key_u, 0.0, last_u), at_v = std::clamp(key_v, 0.0, last_v);
      const int left = static_cast<int>(at_u), top = static_cast<int>(at_v);
      const double du = at_u - left, dv = at_v - top;
      const uint8_t* const upper = key.ptr<uint8_t>(top) + left;
      const uint8_t* const lower = key.ptr<uint8_t>(top + 1) + left;
      const double grey =
          (1.0 - dv) * ((1.0 - du) * upper[0] + du * upper[1]) + dv * ((1.0 - du) * lower[0] + du * lower[1]);
      derotated.at<uint8_t>(v, u) = static_cast<uint8_t>(grey + 0.5);
      valid.at<uint8_t>(v, u) = at_u == key_u && at_v == key_v ? 255 : 0;
    }
  }
}

/// Computes the sums of products of gradients over each window, less the part of the noise.
void PlaneSweep::sum_gradients(const cv::Mat& detail) {
  cv::Mat products(height_, width_, CV_32FC3, cv::Scalar::all(0));
  const auto noise = static_cast<float>(0.5 * noise_.grey * noise_.grey);
  for (int v = 1; v + 1 < height_; ++v) {
    const uint8_t *const above = detail.ptr<uint8_t>(v - 1), *const here = detail.ptr<uint8_t>(v),
                         *const below = detail.ptr<uint8_t>(v + 1);
    auto* const row = products.ptr<cv::Vec3f>(v);
    for (int u = 1; u + 1 < width_; ++u) {
      const float gx = 0.5F * static_cast<float>(here[u + 1] - here[u - 1]);
      const float gy = 0.5F * static_cast<float>(below[u] - above[u]);
      row[u] = {gx * gx - noise, gx * gy, gy * gy - noise};
    }
  }
  constexpr int kWindowPx = 2 * kSides + 1;
  cv::boxFilter(products, gradients_, CV_32F, {kWindowPx, kWindowPx}, {-1, -1}, /*normalize=*/false);
}

/// Computes the costs of a plane.
void PlaneSweep::compare(const cv::Mat& current, const cv::Mat& key, const Eigen::Vector3d& p_CCk, int plane) {
  const double per_m = inverse_depth(plane), scale = 1.0 / (1.0 - per_m * p_CCk.z());
  const Axis u_axis = sample_axis(width_, center_u_, scale, focal_ * per_m * p_CCk.x());
  const Axis v_axis = sample_axis(height_, center_v_, scale, focal_ * per_m * p_CCk.y());
  cv::Mat differences(height_, width_, CV_8UC1, cv::Scalar::all(kOutside));
  std::vector<int16_t> blended(static_cast<size_t>(width_));
  std::vector<uint8_t> warped(static_cast<size_t>(width_));
  for (int v = 0; v < height_; ++v) {
    const auto row = static_cast<size_t>(v);
    if (v_axis.first[row] < 0) continue;
    blend(key.ptr<uint8_t>(v_axis.first[row]), key.ptr<uint8_t>(v_axis.first[row] + 1), v_axis.weight[row], width_,
          blended.data());
    for (size_t u = 0; u < warped.size(); ++u) {
      const int first = u_axis.first[u];
      const int16_t* const from = blended.data() + std::max(first, 0);
      const int grey = (from[0] * (kUnit - u_axis.weight[u]) + from[1] * u_axis.weight[u] + kUnit * kUnit / 2) >> 10;
      warped[u] = first < 0 ? kOutside : static_cast<uint8_t>(grey);
    }
    absolute_difference(current.ptr<uint8_t>(v), warped.data(), width_, differences.ptr<uint8_t>(v));
  }
  int16_t* const costs = costs_.data() + static_cast<size_t>(plane) * pixels();
  std::vector<int16_t> sums(static_cast<size_t>(width_), 0);
  const std::vector<uint8_t> none(static_cast<size_t>(width_), 0);
  for (int v = 0; v < height_ + kSides; ++v) {
    const int leaving = v - 2 * kSides - 1, middle = v - kSides;
    replace_row(leaving < 0 ? none.data() : differences.ptr<uint8_t>(leaving),
                v < height_ ? differences.ptr<uint8_t>(v) : none.data(), width_, sums.data());
    if (middle < kSides || middle >= height_ - kSides) continue;
    sum_columns(sums.data() + kSides, kSides, width_ - 2 * kSides, costs + middle * width_ + kSides);
  }
}

void PlaneSweep::find_best() {
  best_.assign(pixels(), kNoCost);
  best_plane_.assign(pixels(), 0);
  for (int plane = 0; plane < kPlanes + kBeyond; ++plane) {
    keep_smaller(costs_.data() + static_cast<size_t>(plane) * pixels(), static_cast<int16_t>(plane), pixels(),
                 best_.data(), best_plane_.data());
  }
}

/// Finds the minimum cost of depths that displace the match by more than kOtherPx.
void PlaneSweep::find_second(const Eigen::Vector3d& p_CCk) {
  first_near_.resize(pixels());
  last_near_.resize(pixels());
  reach_.resize(pixels());
  second_.assign(pixels(), kNoCost);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const size_t pixel = static_cast<size_t>(v * width_ + u);
      const double step_px =
          step_per_m_ * displacement(ray_C(u, v), p_CCk, inverse_depth(best_plane_[pixel]), focal_).norm();
      const auto planes = [&](double px) { return static_cast<int16_t>(std::ceil(std::min(px / step_px, 999.0))); };
      first_near_[pixel] = static_cast<int16_t>(best_plane_[pixel] - planes(kOtherPx));
      last_near_[pixel] = static_cast<int16_t>(best_plane_[pixel] + planes(kOtherPx));
      reach_[pixel] = planes(kInterpolatedPx);
    }
  }
  for (int plane = 0; plane < kPlanes + kBeyond; ++plane) {
    keep_smaller_outside(costs_.data() + static_cast<size_t>(plane) * pixels(), static_cast<int16_t>(plane), pixels(),
                         first_near_.data(), last_near_.data(), second_.data());
  }
}

/// Sets `matched_` at unique matches whose place in the key image has no different match of less cost.
void PlaneSweep::find_covered(const Eigen::Vector3d& p_CCk, const cv::Mat& valid) {
  key_cost_.assign(pixels(), kNoCost);
  key_plane_.assign(pixels(), 0);
  matched_.assign(pixels(), 0);
  std::vector<int> places(pixels(), -1);
  for (int v = kSides; v < height_ - kSides; ++v) {
    for (int u = kSides; u < width_ - kSides; ++u) {
      const size_t pixel = static_cast<size_t>(v * width_ + u);
      const double per_m = inverse_depth(best_plane_[pixel]), scale = 1.0 / (1.0 - per_m * p_CCk.z());
      const int key_u = static_cast<int>(std::lround(center_u_ + scale * (u - center_u_ - focal_ * per_m * p_CCk.x())));
      const int key_v = static_cast<int>(std::lround(center_v_ + scale * (v - center_v_ - focal_ * per_m * p_CCk.y())));
      if (key_u < kSides || key_v < kSides || key_u >= width_ - kSides || key_v >= height_ - kSides) continue;
      if (!valid.at<uint8_t>(key_v, key_u)) continue;
      const int place = key_v * width_ + key_u;
      places[pixel] = place;
      if (best_[pixel] >= key_cost_[static_cast<size_t>(place)]) continue;
      key_cost_[static_cast<size_t>(place)] = best_[pixel];
      key_plane_[static_cast<size_t>(place)] = best_plane_[pixel];
    }
  }
  for (size_t pixel = 0; pixel < pixels(); ++pixel) {
    if (places[pixel] < 0) continue;
    const int16_t other = key_plane_[static_cast<size_t>(places[pixel])];
    const bool covered = other < first_near_[pixel] || other > last_near_[pixel];
    const bool unique = best_[pixel] * (100 + kUniquePercent) <= second_[pixel] * 100;
    matched_[pixel] = !covered && unique;
  }
}

/// Returns the vertex of the parabola through three costs, in planes; NaN without a minimum.
/// @param reach  planes to the outer two, fewer next to the first and the last plane.
double PlaneSweep::interpolate(size_t pixel, int reach) const {
  const int middle = best_plane_[pixel];
  const int before = std::max(middle - reach, 0), after = std::min(middle + reach, kPlanes + kBeyond - 1);
  const auto cost = [&](int plane) -> double { return costs_[static_cast<size_t>(plane) * pixels() + pixel]; };
  const double left = (cost(before) - cost(middle)) / (middle - before);
  const double right = (cost(after) - cost(middle)) / (after - middle);
  if (before == middle || after == middle || !(left + right > 0.0)) return std::nan("");
  return middle + 0.5 * (left * (after - middle) - right * (middle - before)) / (left + right);
}

InverseDepth PlaneSweep::none() const {
  const cv::Mat none(height_, width_, CV_32FC1, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
  return {none, none.clone()};
}

InverseDepth PlaneSweep::match(const cv::Mat& current, const cv::Mat& key, const CameraMotion& motion) {
  InverseDepth depth = none();
  if (motion.p_CCk.norm() < 1e-6) return depth;
  step_per_m_ = spacing_per_m(motion.p_CCk);
  cv::Mat here, there, valid;
  derotate(current, Eigen::Matrix3d::Identity(), here, valid);
  derotate(key, motion.R_CCk, there, valid);
  cv::erode(valid, valid, cv::Mat::ones(2 * kSides + 1, 2 * kSides + 1, CV_8U));
  here = detail_of(here);
  there = detail_of(there);
  sum_gradients(here);
  costs_.assign(pixels() * (kPlanes + kBeyond), kNoCost);
  for (int plane = 0; plane < kPlanes + kBeyond; ++plane) compare(here, there, motion.p_CCk, plane);
  find_best();
  find_second(motion.p_CCk);
  find_covered(motion.p_CCk, valid);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const size_t pixel = static_cast<size_t>(v * width_ + u);
      if (!matched_[pixel]) continue;
      const double plane = interpolate(pixel, reach_[pixel]);
      if (!std::isfinite(plane)) continue;
      const double per_m = std::max((plane - kBeyond) * step_per_m_, 0.0);
      const Eigen::Vector2d along_px = displacement(ray_C(u, v), motion.p_CCk, per_m, focal_);
      const cv::Vec3f& sums = gradients_.at<cv::Vec3f>(v, u);
      const Eigen::Vector3d gradients(sums[0], sums[1], sums[2]);
      if (noise_px2(gradients, along_px, noise_) > kMaxMatchPx * kMaxMatchPx) continue;
      depth.per_m.at<float>(v, u) = static_cast<float>(per_m);
      depth.sigma_per_m.at<float>(v, u) =
          static_cast<float>(sigma_of_inverse_depth(ray_C(u, v), motion, per_m, focal_, gradients, noise_));
    }
  }
  return depth;
}

}  // namespace hedgehop::vision::motion
