#include "vision/flow/corner_tracker.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

namespace hedgehop::vision::flow {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kMinStepPx = 0.005;
constexpr float kMinEigenvalue = 1e-4F;         // of the mean product of gradients
constexpr int kWeightBits = 14, kGreyBits = 5;  // fractional bits of interpolation weights and of grey levels
constexpr int kLanes = 8;
constexpr int16_t kWithin[2 * kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1};  // ones in all bits, then zeros
constexpr float kScale = 1.0F / (1 << 20);                                 // of sums, as in OpenCV

/// Interpolation weights of the top left and right pixels and of the bottom left and right pixels, in pairs.
struct Weights {
  cv::v_int16x8 top, bottom;
};

Weights weights_at(const cv::Point2f& part) {
  const auto share = [](float value) { return static_cast<int16_t>(cvRound(value * (1 << kWeightBits))); };
  const int16_t a = share((1.0F - part.x) * (1.0F - part.y)), b = share(part.x * (1.0F - part.y)),
                c = share((1.0F - part.x) * part.y), d = static_cast<int16_t>((1 << kWeightBits) - a - b - c);
  return {cv::v_int16x8(a, b, a, b, a, b, a, b), cv::v_int16x8(c, d, c, d, c, d, c, d)};
}

/// Returns eight interpolated values. @param top_right, bottom_right  the values one pixel to the right.
template <int kShift>
cv::v_int16x8 interpolate(const cv::v_int16x8& top, const cv::v_int16x8& top_right, const cv::v_int16x8& bottom,
                          const cv::v_int16x8& bottom_right, const Weights& weights) {
  const auto half = cv::v_setall_s32(1 << (kShift - 1));
  cv::v_int16x8 top_low, top_high, bottom_low, bottom_high;
  cv::v_zip(top, top_right, top_low, top_high);
  cv::v_zip(bottom, bottom_right, bottom_low, bottom_high);
  const auto low = cv::v_dotprod(top_low, weights.top) + cv::v_dotprod(bottom_low, weights.bottom) + half;
  const auto high = cv::v_dotprod(top_high, weights.top) + cv::v_dotprod(bottom_high, weights.bottom) + half;
  return cv::v_pack(low >> kShift, high >> kShift);
}

cv::v_int16x8 interpolate_grey(const uint8_t* upper, const uint8_t* lower, const Weights& weights) {
  const auto eight = [](const uint8_t* from) { return cv::v_reinterpret_as_s16(cv::v_load_expand(from)); };
  return interpolate<kWeightBits - kGreyBits>(eight(upper), eight(upper + 1), eight(lower), eight(lower + 1), weights);
}

/// Sums of products of numbers with at most 13 bits and a sign.
class Sum {
 public:
  void add(const cv::v_int16x8& a, const cv::v_int16x8& b) { part_ = part_ + cv::v_dotprod(a, b); }
  /// Must be called at least every 32 additions, whose sum fits 32 bits.
  void flush() {
    cv::v_int64x2 low, high;
    cv::v_expand(part_, low, high);
    whole_ = whole_ + low + high;
    part_ = cv::v_setzero_s32();
  }
  float scaled() {
    flush();
    int64_t two[2];
    cv::v_store(two, whole_);
    return static_cast<float>(two[0] + two[1]) * kScale;
  }

 private:
  cv::v_int32x4 part_ = cv::v_setzero_s32();
  cv::v_int64x2 whole_ = cv::v_setzero_s64();
};

bool inside(const cv::Point& at, int window, const cv::Mat& image) {
  return at.x >= -window && at.x < image.cols && at.y >= -window && at.y < image.rows;
}

}  // namespace

CornerTracker::CornerTracker(int window_px, int levels)
    : window_(window_px),
      levels_(levels),
      stride_((window_px + kLanes - 1) / kLanes * kLanes),
      rows_at_once_(32 * kLanes / stride_) {
  const auto line = static_cast<size_t>(stride_), rows = static_cast<size_t>(window_);
  for (auto* numbers : {&grey_, &gradient_x_, &gradient_y_}) numbers->assign(rows * line, int16_t{0});
  pixels_.resize((rows + 1) * (line + kLanes));
  gradients_.resize((rows + 1) * 2 * (line + kLanes));
}

/// Returns the pixels of the window at `at` and one more row and column. It is safe to read a few values beyond each
/// row; close to the right border the pixels are copied to `spare`.
template <class Number>
CornerTracker::Rows<Number> CornerTracker::rows_at(const cv::Mat& image, const cv::Point& at,
                                                   std::vector<Number>& spare) const {
  const auto step = static_cast<ptrdiff_t>(image.step1()), channels = static_cast<ptrdiff_t>(image.channels());
  const Number* first = reinterpret_cast<const Number*>(image.data) + at.y * step + at.x * channels;
  if (at.x + stride_ + kLanes < image.cols) return {first, step};
  const ptrdiff_t spare_step = channels * (stride_ + kLanes);
  for (int y = 0; y <= window_; ++y) {
    std::copy_n(first + y * step, channels * (window_ + 1), spare.data() + y * spare_step);
  }
  return {spare.data(), spare_step};
}

CornerTracker::NormalMatrix CornerTracker::load_window(const cv::Mat& image, const cv::Mat& gradients,
                                                       const cv::Point2f& corner) {
  const cv::Point at(cvFloor(corner.x), cvFloor(corner.y));
  NormalMatrix normal;
  if (!inside(at, window_, gradients)) return normal;
  const Weights weights = weights_at(corner - cv::Point2f(at));
  const auto greys = rows_at(image, at, pixels_);
  const auto slopes = rows_at(gradients, at, gradients_);
  Sum xx, xy, yy;
  for (int y = 0; y < window_; ++y) {
    const ptrdiff_t to = static_cast<ptrdiff_t>(y) * stride_;
    for (int x = 0; x < stride_; x += kLanes) {
      const uint8_t* grey = greys.first + y * greys.step + x;
      cv::v_store(grey_.data() + to + x, interpolate_grey(grey, grey + greys.step, weights));
      cv::v_int16x8 px[4], py[4];
      for (int i = 0; i < 4; ++i) {
        cv::v_load_deinterleave(slopes.first + (y + i / 2) * slopes.step + 2 * (x + i % 2), px[i], py[i]);
      }
      const auto within = cv::v_load(kWithin + kLanes - std::min(kLanes, window_ - x));
      const auto slope_x = interpolate<kWeightBits>(px[0], px[1], px[2], px[3], weights) & within;
      const auto slope_y = interpolate<kWeightBits>(py[0], py[1], py[2], py[3], weights) & within;
      cv::v_store(gradient_x_.data() + to + x, slope_x);
      cv::v_store(gradient_y_.data() + to + x, slope_y);
      xx.add(slope_x, slope_x);
      xy.add(slope_x, slope_y);
      yy.add(slope_y, slope_y);
    }
    if (y % rows_at_once_ == 0) xx.flush(), xy.flush(), yy.flush();
  }
  normal.xx = xx.scaled();
  normal.xy = xy.scaled();
  normal.yy = yy.scaled();
  normal.determinant = normal.xx * normal.yy - normal.xy * normal.xy;
  const float apart = normal.xx - normal.yy, pixels = static_cast<float>(window_ * window_);
  const float min_eigenvalue =
      (normal.xx + normal.yy - std::sqrt(apart * apart + 4.0F * normal.xy * normal.xy)) / (2.0F * pixels);
  normal.solvable = min_eigenvalue >= kMinEigenvalue && normal.determinant >= FLT_EPSILON;
  return normal;
}

/// Returns the sum over the window of the difference to another image times the gradients. Outside the window the
/// gradients are zero.
cv::Point2f CornerTracker::mismatch(const cv::Mat& image, const cv::Point& at, const cv::Point2f& part) {
  const Weights weights = weights_at(part);
  const auto greys = rows_at(image, at, pixels_);
  Sum sum_x, sum_y;
  for (int y = 0; y < window_; ++y) {
    const ptrdiff_t from = static_cast<ptrdiff_t>(y) * stride_;
    for (int x = 0; x < stride_; x += kLanes) {
      const uint8_t* grey = greys.first + y * greys.step + x;
      const auto difference = interpolate_grey(grey, grey + greys.step, weights) - cv::v_load(grey_.data() + from + x);
      sum_x.add(difference, cv::v_load(gradient_x_.data() + from + x));
      sum_y.add(difference, cv::v_load(gradient_y_.data() + from + x));
    }
    if (y % rows_at_once_ == 0) sum_x.flush(), sum_y.flush();
  }
  return {sum_x.scaled(), sum_y.scaled()};
}

/// Moves `place` to the minimum difference. @return whether it remained inside the image.
bool CornerTracker::search(const cv::Mat& image, const NormalMatrix& normal, cv::Point2f& place) {
  cv::Point2f last_step;
  for (int i = 0; i < kMaxIterations; ++i) {
    const cv::Point at(cvFloor(place.x), cvFloor(place.y));
    if (!inside(at, window_, image)) return false;
    const cv::Point2f sum = mismatch(image, at, place - cv::Point2f(at));
    const float over = 1.0F / normal.determinant;
    const cv::Point2f step((normal.xy * sum.y - normal.yy * sum.x) * over,
                           (normal.xy * sum.x - normal.xx * sum.y) * over);
    place += step;
    if (step.ddot(step) <= kMinStepPx * kMinStepPx) break;
    constexpr double kSwing = 0.01;  // if the steps oscillate, take the midpoint
    if (i > 0 && std::abs(step.x + last_step.x) < kSwing && std::abs(step.y + last_step.y) < kSwing) {
      place -= step * 0.5F;
      break;
    }
    last_step = step;
  }
  return true;
}

std::optional<cv::Point2f> CornerTracker::track(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                                const cv::Point2f& corner, const std::optional<cv::Point2f>& guess) {
  const float half = 0.5F * static_cast<float>(window_ - 1);
  const cv::Point2f middle(half, half);
  const int coarsest = static_cast<int>(std::min(from.size(), to.size())) / 2 - 1;
  const int first = std::min(levels_ - 1, coarsest);
  cv::Point2f place = guess.value_or(corner) * (1.0F / static_cast<float>(1 << first));
  for (int level = first; level >= 0; --level) {
    if (level < first) place *= 2.0F;
    const auto image = static_cast<size_t>(2 * level);
    const NormalMatrix normal =
        load_window(from[image], from[image + 1], corner * (1.0F / static_cast<float>(1 << level)) - middle);
    if (!normal.solvable) {
      if (level == 0) return std::nullopt;
      continue;
    }
    place -= middle;
    const bool stayed = search(to[image], normal, place);
    place += middle;
    if (!stayed && level == 0) return std::nullopt;
  }
  return place;
}

}  // namespace hedgehop::vision::flow
