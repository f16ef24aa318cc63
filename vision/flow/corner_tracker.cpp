#include "vision/flow/corner_tracker.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "vision/flow/corner_window.h"

namespace hedgehop::vision::flow {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kMinStepPx = 0.005;
constexpr float kMinEigenvalue = 1e-4F;  // of the mean product of gradients
constexpr int kLanes = CornerRows::kLanes;

/// Returns a sum as OpenCV scales it.
float scaled(int64_t sum) { return static_cast<float>(sum) * (1.0F / (1 << 20)); }

bool inside(const cv::Point& at, int window, const cv::Mat& image) {
  return at.x >= -window && at.x < image.cols && at.y >= -window && at.y < image.rows;
}

}  // namespace

CornerTracker::CornerTracker(int window_px, int levels)
    : window_(window_px), levels_(levels), stride_((window_px + kLanes - 1) / kLanes * kLanes) {
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

CornerRows CornerTracker::window_rows(const Rows<uint8_t>& greys) {
  return {greys.first, greys.step, nullptr, 0, grey_.data(), gradient_x_.data(), gradient_y_.data(), window_, stride_};
}

CornerTracker::NormalMatrix CornerTracker::load_window(const cv::Mat& image, const cv::Mat& gradients,
                                                       const cv::Point2f& corner) {
  const cv::Point at(cvFloor(corner.x), cvFloor(corner.y));
  NormalMatrix normal;
  if (!inside(at, window_, gradients)) return normal;
  const auto greys = rows_at(image, at, pixels_);
  const auto slopes = rows_at(gradients, at, gradients_);
  CornerRows rows = window_rows(greys);
  rows.gradients = slopes.first;
  rows.gradient_step = slopes.step;
  const auto products = load_rows(rows, CornerWeights(corner - cv::Point2f(at)));
  normal.xx = scaled(products[0]);
  normal.xy = scaled(products[1]);
  normal.yy = scaled(products[2]);
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
  const auto sums = mismatch_of_rows(window_rows(rows_at(image, at, pixels_)), CornerWeights(part));
  return {scaled(sums[0]), scaled(sums[1])};
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
