#include "vision/flow/recentered_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::flow {
namespace {

constexpr double kQ16 = 65536.0;
constexpr size_t kRoom = 4;  // values that may be written beyond the end

constexpr int kFraction = 7, kOne = 1 << kFraction;  // positions in 1/128 px
constexpr int kStrip = 512;                          // columns at a time
constexpr int kCopied = 8;

// Integers only, so that the result does not depend on the register width.
HEDGEHOP_WIDE void round_to_positions(const int32_t* q16, int count, int16_t* position) {
  constexpr int kShift = 16 - kFraction, kHalf = 1 << (kShift - 1);
  for (int i = 0; i < count; ++i) position[i] = static_cast<int16_t>((q16[i] + kHalf) >> kShift);
}

HEDGEHOP_WIDE void add_to(int32_t* numbers, const int32_t* steps, int count) {
  for (int i = 0; i < count; ++i) numbers[i] += steps[i];
}

// Subtracts the bilinear interpolation between four neighbors from the older image. Each product fits 16 bits:
//   top = (left (128 - s) + right s + 8) >> 4 = 8 left + (((right - left) s + 8) >> 4)
//   value = (top (128 - t) + bottom t + 512) >> 10 = (top + 4 + (((bottom - top) t) >> 7)) >> 3
HEDGEHOP_WIDE void subtract_interpolated(const int16_t* older, const int16_t* const (&corners)[4], const int16_t* u,
                                         const int16_t* v, int count, int16_t* out) {
  const int16_t *top_left = corners[0], *top_right = corners[1], *bottom_left = corners[2], *bottom_right = corners[3];
  for (int i = 0; i < count; ++i) {
    const auto share_u = static_cast<int16_t>((u[i] & (kOne - 1)) << 8);
    const auto right_top = static_cast<int16_t>((top_right[i] - top_left[i]) * 8);
    const auto right_bottom = static_cast<int16_t>((bottom_right[i] - bottom_left[i]) * 8);
    const auto top_step = static_cast<int16_t>((((right_top * share_u) >> 14) + 1) >> 1);
    const auto bottom_step = static_cast<int16_t>((((right_bottom * share_u) >> 14) + 1) >> 1);
    const auto top = static_cast<int16_t>(top_left[i] * 8 + top_step);
    const auto bottom = static_cast<int16_t>(bottom_left[i] * 8 + bottom_step);
    // The weight requires 16 unsigned bits. For the upper half of its range, one full step is added back.
    const auto share_v = static_cast<int16_t>(static_cast<uint16_t>(v[i]) << 9);
    const auto down = static_cast<int16_t>(bottom - top);
    const auto part = static_cast<int16_t>((down * share_v) >> 16);
    const auto step = static_cast<int16_t>(part + (share_v < 0 ? down : int16_t{0}));
    out[i] = static_cast<int16_t>(older[i] - (static_cast<int16_t>(top + step + 4) >> 3));
  }
}

// Working buffers for a range of columns in one row.
struct ColumnStrip {
  int count = 0;
  int16_t u[kStrip + kCopied], v[kStrip + kCopied];  ///< 1/128 px
  int16_t corners[4][kStrip + kCopied];  ///< of the newer image around each column's position: top, bottom; left, right

  void round(const int32_t* u_q16, const int32_t* v_q16) {
    round_to_positions(u_q16, count, u);
    round_to_positions(v_q16, count, v);
    for (int16_t* numbers : {u, v}) std::fill_n(numbers + count, kCopied, int16_t{0});
  }

  // Copies runs of columns with equal integer flow, whose source pixels are adjacent.
  void fetch(const ReducedImage& newer, int x, int y) {
    const ptrdiff_t stride = newer.stride();
    for (int i = 0; i < count;) {
      const int whole_u = u[i] >> kFraction, whole_v = v[i] >> kFraction;
      const int16_t* from = newer.row(y + whole_v) + x + i + whole_u;
      const auto all_u = cv::v_setall_s16(static_cast<int16_t>(whole_u));
      const auto all_v = cv::v_setall_s16(static_cast<int16_t>(whole_v));
      for (int corner = 0; corner < 4; ++corner) {
        cv::v_store(corners[corner] + i, cv::v_load(from + (corner / 2) * stride + corner % 2));
      }
      const auto leave = ((cv::v_load(u + i) >> kFraction) != all_u) | ((cv::v_load(v + i) >> kFraction) != all_v);
      i += cv::v_check_any(leave) ? cv::v_scan_forward(leave) : kCopied;
    }
  }

  void subtract(const int16_t* older, int16_t* out) const {
    subtract_interpolated(older, {corners[0], corners[1], corners[2], corners[3]}, u, v, count, out);
  }

  // Sets the difference to 0 outside the newer image. Flow does not exceed the rim.
  void clear_outside(const ReducedImage& newer, int x, int y, int16_t* out) const {
    const int last_x = newer.width() - 1, last_y = newer.height() - 1, rim = newer.rim();
    const auto clear = [&](int i) {
      const int at_x = (x + i) * kOne + u[i], at_y = y * kOne + v[i];
      if (at_x < 0 || at_x > last_x * kOne || at_y < 0 || at_y > last_y * kOne) out[i] = 0;
    };
    const bool near_rows = y < rim || y > last_y - rim;
    const int begin = near_rows ? count : std::clamp(rim - x, 0, count);
    const int end = near_rows ? count : std::clamp(last_x - rim + 1 - x, begin, count);
    for (int i = 0; i < begin; ++i) clear(i);
    for (int i = end; i < count; ++i) clear(i);
  }
};

}  // namespace

SpreadFlow::SpreadFlow(std::span<const double> node_u, std::span<const double> node_v, int width)
    : node_v_(node_v.begin(), node_v.end()),
      width_(width),
      rows_(static_cast<int>(node_v.size())),
      cols_(static_cast<int>(node_u.size())) {
  for (int x = 0; x < width; ++x) {
    int left = 0;
    while (left + 2 < cols_ && x >= node_u[static_cast<size_t>(left) + 1]) ++left;
    const double from = node_u[static_cast<size_t>(left)];
    const double to = node_u[static_cast<size_t>(std::min(left + 1, cols_ - 1))];
    first_column_.resize(static_cast<size_t>(left) + 1, x);
    right_share_.push_back(to > from ? std::clamp((x - from) / (to - from), 0.0, 1.0) : 0.0);
  }
  first_column_.resize(static_cast<size_t>(std::max(2, cols_)), width);
  right_share_.resize(static_cast<size_t>(padded(width)) + kRoom, 0.0);
  const auto line = static_cast<size_t>(padded(width));
  for (auto* lines : {&lines_u_, &lines_v_}) lines->assign(line * node_v.size() + kRoom, 0);
  for (auto* row : {&u_, &v_, &step_u_, &step_v_}) row->assign(line, 0);
}

void SpreadFlow::set(std::span<const double> flow_u, std::span<const double> flow_v) {
  spread_sideways(flow_u, lines_u_);
  spread_sideways(flow_v, lines_v_);
  y_ = band_end_ = -1;
}

void SpreadFlow::spread_sideways(std::span<const double> flow, std::vector<int32_t>& lines) const {
  for (int row = 0; row < rows_; ++row) {
    const double* node = flow.data() + static_cast<ptrdiff_t>(row) * cols_;
    int32_t* line = lines.data() + static_cast<ptrdiff_t>(row) * padded(width_);
    for (int left = 0; left < std::max(1, cols_ - 1); ++left) {
      const double difference = node[std::min(left + 1, cols_ - 1)] - node[left];
      spread_between(node[left], difference, first_column_[static_cast<size_t>(left)],
                     first_column_[static_cast<size_t>(left) + 1], line);
    }
  }
}

// Writes groups of four from the left; values beyond the end are overwritten by the next range.
void SpreadFlow::spread_between(double from, double difference, int begin, int end, int32_t* line) const {
  const auto start = cv::v_setall_f64(from), whole = cv::v_setall_f64(difference), q16 = cv::v_setall_f64(kQ16);
  for (int x = begin; x < end; x += 4) {
    const auto low = start + cv::v_load(right_share_.data() + x) * whole;
    const auto high = start + cv::v_load(right_share_.data() + x + 2) * whole;
    cv::v_store(line + x, cv::v_round(low * q16, high * q16));
  }
}

void SpreadFlow::go_to(int y) {
  if (y != y_ + 1 || y >= band_end_) {
    start_band(y);
  } else {
    const auto count = static_cast<int>(u_.size());
    add_to(u_.data(), step_u_.data(), count);
    add_to(v_.data(), step_v_.data(), count);
  }
  y_ = y;
}

void SpreadFlow::start_band(int y) {
  int above = 0;
  while (above + 2 < rows_ && y >= node_v_[static_cast<size_t>(above) + 1]) ++above;
  const int below = std::min(above + 1, rows_ - 1);
  const double from = node_v_[static_cast<size_t>(above)], to = node_v_[static_cast<size_t>(below)];
  const bool inside = below > above && y >= from && y < to;
  const double share = inside ? (y - from) / (to - from) : (y < from ? 0.0 : 1.0);
  const double step = inside ? 1.0 / (to - from) : 0.0;
  // Above the first node and below the last one the flow is constant. The band ends at the next node.
  if (inside) {
    band_end_ = static_cast<int>(std::ceil(to));
  } else {
    band_end_ = y < from ? static_cast<int>(std::ceil(from)) : std::numeric_limits<int>::max();
  }
  const auto spread = [&](const std::vector<int32_t>& lines, std::vector<int32_t>& values,
                          std::vector<int32_t>& steps) {
    const int32_t* top = lines.data() + static_cast<ptrdiff_t>(above) * padded(width_);
    const int32_t* bottom = lines.data() + static_cast<ptrdiff_t>(below) * padded(width_);
    const auto part = cv::v_setall_f64(share), per_row = cv::v_setall_f64(step);
    for (size_t x = 0; x < values.size(); x += 4) {
      const auto above_x = cv::v_load(top + x), below_x = cv::v_load(bottom + x);
      const auto low = cv::v_cvt_f64(above_x), high = cv::v_cvt_f64_high(above_x);
      const auto low_difference = cv::v_cvt_f64(below_x) - low, high_difference = cv::v_cvt_f64_high(below_x) - high;
      cv::v_store(&values[x], cv::v_round(low + part * low_difference, high + part * high_difference));
      cv::v_store(&steps[x], cv::v_round(per_row * low_difference, per_row * high_difference));
    }
  };
  spread(lines_u_, u_, step_u_);
  spread(lines_v_, v_, step_v_);
}

void recentered_difference(const ReducedImage& older, const ReducedImage& newer, int y, const int32_t* u_q16,
                           const int32_t* v_q16, int16_t* out, const PatchRange& columns) {
  const int16_t* old_row = older.row(y);
  ColumnStrip strip;
  for (int x = columns.begin; x < columns.end; x += kStrip) {
    strip.count = std::min(kStrip, columns.end - x);
    strip.round(u_q16 + x, v_q16 + x);
    strip.fetch(newer, x, y);
    strip.subtract(old_row + x, out + x);
    strip.clear_outside(newer, x, y, out + x);
  }
}

void recentered_difference(const ReducedImage& older, const ReducedImage& newer, int y, const int32_t* u_q16,
                           const int32_t* v_q16, int16_t* out) {
  recentered_difference(older, newer, y, u_q16, v_q16, out, {0, padded(older.width())});
}

}  // namespace hedgehop::vision::flow
