#include "vision/flow/recentered_difference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core/hal/intrin.hpp>

namespace hedgehop::vision::flow {
namespace {

constexpr double kQ16 = 65536.0;

// Two neighboring numbers at each of four places (which need not be aligned to 32 bits).
cv::v_int16x8 neighbors(const int16_t* base, const int (&index)[4]) {
  int32_t pairs[4];
  for (int i = 0; i < 4; ++i) std::memcpy(&pairs[i], base + index[i], sizeof(int32_t));
  return cv::v_reinterpret_as_s16(cv::v_int32x4(pairs[0], pairs[1], pairs[2], pairs[3]));
}

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
    left_node_.push_back(left);
    right_share_.push_back(to > from ? std::clamp((x - from) / (to - from), 0.0, 1.0) : 0.0);
  }
  const auto line = static_cast<size_t>(padded(width));
  for (auto* lines : {&lines_u_, &lines_v_}) lines->assign(line * node_v.size(), 0);
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
    for (int x = 0; x < width_; ++x) {
      const auto i = static_cast<size_t>(x);
      const int left = left_node_[i], right = std::min(left + 1, cols_ - 1);
      const double value = node[left] + right_share_[i] * (node[right] - node[left]);
      line[x] = static_cast<int32_t>(std::lrint(value * kQ16));
    }
  }
}

void SpreadFlow::go_to(int y) {
  if (y != y_ + 1 || y >= band_end_) {
    start_band(y);
  } else {
    for (size_t x = 0; x < u_.size(); ++x) u_[x] += step_u_[x];
    for (size_t x = 0; x < v_.size(); ++x) v_[x] += step_v_[x];
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
  // Above the first node and below the last the flow stays constant; the band ends where a new formula begins.
  if (inside) {
    band_end_ = static_cast<int>(std::ceil(to));
  } else {
    band_end_ = y < from ? static_cast<int>(std::ceil(from)) : std::numeric_limits<int>::max();
  }
  const auto spread = [&](const std::vector<int32_t>& lines, std::vector<int32_t>& values,
                          std::vector<int32_t>& steps) {
    const int32_t* top = lines.data() + static_cast<ptrdiff_t>(above) * padded(width_);
    const int32_t* bottom = lines.data() + static_cast<ptrdiff_t>(below) * padded(width_);
    for (size_t x = 0; x < values.size(); ++x) {
      const double difference = static_cast<double>(bottom[x]) - top[x];
      values[x] = static_cast<int32_t>(std::lrint(top[x] + share * difference));
      steps[x] = static_cast<int32_t>(std::lrint(step * difference));
    }
  };
  spread(lines_u_, u_, step_u_);
  spread(lines_v_, v_, step_v_);
}

void recentered_difference(const ReducedImage& older, const ReducedImage& newer, int y, const int32_t* u_q16,
                           const int32_t* v_q16, int16_t* out) {
  constexpr int kFraction = 7, kOne = 1 << kFraction;  // positions in 1/128 px
  constexpr int kShift = 16 - kFraction, kHalf = 1 << (kShift - 1);
  constexpr int kKeep = 4;  // bits dropped after the sideways step, to fit 16
  constexpr int kDrop = 2 * kFraction - kKeep;

  const int16_t* base = newer.row(0);
  const int16_t* old_row = older.row(y);
  const auto last_x = cv::v_setall_s32((newer.width() - 1) * kOne),
             last_y = cv::v_setall_s32((newer.height() - 1) * kOne);
  const auto zero = cv::v_setzero_s32(), fraction_bits = cv::v_setall_s32(kOne - 1),
             low_half = cv::v_setall_s32(0xffff);
  const auto one = cv::v_setall_s32(kOne), row_half = cv::v_setall_s32(kHalf);
  const auto keep_half = cv::v_setall_s32(1 << (kKeep - 1)), drop_half = cv::v_setall_s32(1 << (kDrop - 1));
  const auto stride = static_cast<int16_t>(newer.stride());
  const cv::v_int16x8 address(stride, 1, stride, 1, stride, 1, stride, 1);
  const auto row_y = cv::v_setall_s32(y * kOne), step_x = cv::v_setall_s32(4 * kOne);
  auto column_x = cv::v_int32x4(0, kOne, 2 * kOne, 3 * kOne);

  // Two numbers of 16 bits side by side in each 32.
  const auto pair = [&](const cv::v_int32x4& low, const cv::v_int32x4& high) {
    return cv::v_reinterpret_as_s16((low & low_half) | (high << 16));
  };
  const auto four = [&](int x) {
    const auto at_x = column_x + ((cv::v_load(u_q16 + x) + row_half) >> kShift);
    const auto at_y = row_y + ((cv::v_load(v_q16 + x) + row_half) >> kShift);
    column_x = column_x + step_x;
    const auto inside = (at_x >= zero) & (at_x <= last_x) & (at_y >= zero) & (at_y <= last_y);
    const auto share_x = at_x & fraction_bits, share_y = at_y & fraction_bits;

    int index[4];
    cv::v_store(index, cv::v_dotprod(pair(at_y >> kFraction, at_x >> kFraction), address));
    const auto weight_x = pair(one - share_x, share_x);
    const auto top = (cv::v_dotprod(neighbors(base, index), weight_x) + keep_half) >> kKeep;
    const auto bottom = (cv::v_dotprod(neighbors(base + stride, index), weight_x) + keep_half) >> kKeep;
    const auto value = (cv::v_dotprod(pair(top, bottom), pair(one - share_y, share_y)) + drop_half) >> kDrop;

    // Outside, the newer image is taken to look like the older one.
    return (value & inside) | (cv::v_load_expand(old_row + x) & ~inside);
  };
  for (int x = 0; x < older.width(); x += 8) {
    const auto left = four(x);
    const auto right = four(x + 4);
    cv::v_store(out + x, cv::v_load(old_row + x) - cv::v_pack(left, right));
  }
}

}  // namespace hedgehop::vision::flow
