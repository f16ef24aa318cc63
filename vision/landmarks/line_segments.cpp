#include "vision/landmarks/edge_corners.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "sim/fields/order_statistics.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;

// Minimum gradient of a line's maxima: relative to the texture of the image, and absolute, above the noise of dark
// images.
constexpr double kOfTexture = 1.5, kMinStrength = 16.0;
constexpr double kSeed = 1.3;  // hysteresis: at least one of the connected maxima is stronger by this factor

/// State of a pixel: not a maximum of the gradient, not yet examined, not on a line of sufficient length, or on a line.
/// cv::Canny() writes the first two.
enum PixelState : uchar { kNone = 0, kFresh = 255, kTried = 2, kTaken = 1 };

struct Gradient {
  cv::Mat dx, dy;  ///< CV_16SC1; at most eight times the height of a step between dark and light
};

Gradient gradient_of(const cv::Mat& plane) {
  cv::Mat smooth;
  cv::GaussianBlur(plane, smooth, {3, 3}, 0.0);
  Gradient gradient;
  cv::spatialGradient(smooth, gradient.dx, gradient.dy);
  return gradient;
}

/// Returns the 85 % quantile of the gradient, the strength of texture and noise, from every fourth pixel in both
/// directions.
double texture_strength(const Gradient& gradient) {
  constexpr int kStep = 4;
  constexpr size_t kPercent = 85;
  std::vector<int> squares;
  for (int v = 0; v < gradient.dx.rows; v += kStep) {
    for (int u = 0; u < gradient.dx.cols; u += kStep) {
      const int x = gradient.dx.at<short>(v, u), y = gradient.dy.at<short>(v, u);
      squares.push_back(x * x + y * y);
    }
  }
  const int rank = kth_smallest(squares, squares.size() * kPercent / 100);
  return std::sqrt(static_cast<double>(rank));
}

/// Follows straight lines along the maxima of an image's gradient.
class LineFollower {
 public:
  LineFollower(const Gradient& gradient, cv::Mat& state)
      : dx_(gradient.dx.ptr<short>()),
        dy_(gradient.dy.ptr<short>()),
        state_(state.ptr<uchar>()),
        columns_(state.cols),
        rows_(state.rows) {}

  std::vector<ImageEdge> lines() {
    std::vector<ImageEdge> found;
    for (int v = 1; v < rows_ - 1; ++v) {
      for (int u = 1; u < columns_ - 1; ++u) {
        if (state_[v * columns_ + u] != kFresh) continue;
        if (const auto line = follow(u, v)) found.push_back(*line);
      }
    }
    return found;
  }

 private:
  /// Follows the line through a pixel. The line is represented as a function `across` of `along`, the image axis closer
  /// to its direction.
  std::optional<ImageEdge> follow(int u, int v) {
    const int seed = v * columns_ + u;
    normal_ = {dx_[seed], dy_[seed]};
    flat_ = std::abs(normal_.y()) >= std::abs(normal_.x());
    along_stride_ = flat_ ? 1 : columns_;
    across_stride_ = flat_ ? columns_ : 1;
    along_end_ = (flat_ ? columns_ : rows_) - 1;
    across_end_ = (flat_ ? rows_ : columns_) - 1;
    across_gradient_ = flat_ ? dy_ : dx_;
    first_ = last_ = origin_ = flat_ ? u : v;
    sum_s_ = sum_c_ = sum_ss_ = sum_sc_ = 0.0;
    pixels_.clear();
    const int across = flat_ ? v : u;
    hit(origin_, seed, subpixel(seed, across));
    for (const int step : {+1, -1, +1}) extend(step);

    constexpr int kMinHits = 9;
    constexpr double kMinShare = 0.6;
    const bool is_line = hits() >= kMinHits && hits() >= kMinShare * (last_ - first_ + 1);
    for (const int pixel : pixels_) state_[pixel] = is_line ? kTaken : kTried;
    return is_line ? std::optional(edge()) : std::nullopt;
  }

  void extend(int step) {
    constexpr int kMaxGap = 3;
    int& end = step > 0 ? last_ : first_;
    int gap = 0;
    for (int along = end + step; along >= 1 && along < along_end_ && gap <= kMaxGap; along += step) {
      const double expected = across_at(along);
      const int nearest = static_cast<int>(std::floor(expected + 0.5));
      const int aside = expected > nearest ? 1 : -1;
      ++gap;
      for (const int c : {nearest, nearest + aside, nearest - aside}) {
        if (c < 1 || c >= across_end_) continue;
        const int pixel = along * along_stride_ + c * across_stride_;
        if (state_[pixel] < kTried || !is_along(pixel)) continue;
        constexpr double kOffPx = 1.0;
        const double fine = subpixel(pixel, c);
        if (std::abs(fine - expected) > kOffPx) continue;
        hit(along, pixel, fine);
        end = along;
        gap = 0;
        break;
      }
    }
  }

  /// Returns whether a pixel's gradient has the direction and sign of the line's.
  bool is_along(int pixel) const {
    constexpr double kCosine2 = 0.85355339;  // of 22.5 degrees, squared
    const double x = dx_[pixel], y = dy_[pixel], dot = x * normal_.x() + y * normal_.y();
    return dot > 0.0 && dot * dot >= kCosine2 * (x * x + y * y) * normal_.squaredNorm();
  }
  /// Returns the position of the maximum gradient across the line, by a parabola through three pixels.
  double subpixel(int pixel, int across) const {
    const int before = std::abs(across_gradient_[pixel - across_stride_]), here = std::abs(across_gradient_[pixel]),
              after = std::abs(across_gradient_[pixel + across_stride_]);
    const int bend = 2 * here - before - after;
    return bend > 0 ? across + std::clamp(0.5 * (after - before) / bend, -1.0, 1.0) : across;
  }
  void hit(int along, int pixel, double fine) {
    const double s = along - origin_;
    sum_s_ += s;
    sum_c_ += fine;
    sum_ss_ += s * s;
    sum_sc_ += s * fine;
    if (!pixels_.empty()) normal_ += Vector2d(dx_[pixel], dy_[pixel]);
    pixels_.push_back(pixel);
    // A short line takes its direction from the mean gradient.
    constexpr int kFitted = 8;
    const double n = hits();
    slope_ = hits() >= kFitted ? (n * sum_sc_ - sum_s_ * sum_c_) / (n * sum_ss_ - sum_s_ * sum_s_)
             : flat_           ? -normal_.x() / normal_.y()
                               : -normal_.y() / normal_.x();
    offset_ = (sum_c_ - slope_ * sum_s_) / n;
  }

  int hits() const { return static_cast<int>(pixels_.size()); }
  double across_at(int along) const { return offset_ + slope_ * (along - origin_); }
  Vector2d at(int along) const { return flat_ ? Vector2d(along, across_at(along)) : Vector2d(across_at(along), along); }
  /// Returns the edge with the brighter side on its right, as seen in the image.
  ImageEdge edge() const {
    const ImageEdge e{at(first_), at(last_)};
    const Vector2d d = e.to_px - e.from_px;
    return d.x() * normal_.y() - d.y() * normal_.x() > 0.0 ? e : ImageEdge{e.to_px, e.from_px};
  }

  const short *dx_, *dy_;
  uchar* state_;
  int columns_, rows_;

  bool flat_ = true;  ///< whether `along` is u
  int along_stride_ = 1, across_stride_ = 1, along_end_ = 0, across_end_ = 0;
  const short* across_gradient_ = nullptr;
  int origin_ = 0, first_ = 0, last_ = 0;  ///< in `along`
  Vector2d normal_ = Vector2d::Zero();     ///< sum of the gradients
  double sum_s_ = 0.0, sum_c_ = 0.0, sum_ss_ = 0.0, sum_sc_ = 0.0, slope_ = 0.0, offset_ = 0.0;
  std::vector<int> pixels_;
};

}  // namespace

std::vector<ImageEdge> line_segments(const cv::Mat& plane) {
  const Gradient gradient = gradient_of(plane);
  const double low = std::max(kMinStrength, kOfTexture * texture_strength(gradient));
  cv::Mat state;
  cv::Canny(gradient.dx, gradient.dy, state, low, kSeed * low, /*L2gradient=*/true);
  return LineFollower(gradient, state).lines();
}

}  // namespace hedgehop::vision::landmarks
