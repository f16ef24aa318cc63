#include "vision/mapping/depth_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace hedgehop::vision::mapping {
namespace {

constexpr int kPx = DepthBlocks::kBlockPx;

/// The largest disparity but for a few pixels: single ones are wrong, and a pole of one pixel leaves a column of eight.
void read_disparity(const cv::Mat& disparity16, int row, int col, DepthBlock& block) {
  constexpr int kLeastMatched = kPx * kPx / 2;  // half of a block stands for it
  constexpr int kLeastNear = 6;                 // what a pole of one pixel leaves
  std::array<int16_t, kPx * kPx> matched;
  int count = 0;
  for (int v = row * kPx; v < (row + 1) * kPx; ++v) {
    const auto* const d = disparity16.ptr<int16_t>(v) + col * kPx;
    for (int u = 0; u < kPx; ++u) {
      matched[static_cast<size_t>(count)] = d[u];
      count += d[u] >= 0;
    }
  }
  block.kind = count >= kLeastMatched ? DepthBlock::Kind::matched : DepthBlock::Kind::unknown;
  block.near16 = -1;
  if (count < kLeastNear) return;
  const auto rank = matched.begin() + std::max(2, count / 16);
  std::nth_element(matched.begin(), rank, matched.begin() + count, std::greater<>());
  block.near16 = *rank;
}

void read_grey(const cv::Mat& grey, int row, int col, DepthBlock& block) {
  constexpr int kHalf = kPx / 2;
  std::array<int, 4> quarter{};
  for (int v = 0; v < kPx; ++v) {
    const auto* const g = grey.ptr<uint8_t>(row * kPx + v) + col * kPx;
    for (int u = 0; u < kPx; ++u) quarter[static_cast<size_t>(2 * (v / kHalf) + u / kHalf)] += g[u];
  }
  const auto [least, most] = std::ranges::minmax(quarter);
  const int sum = quarter[0] + quarter[1] + quarter[2] + quarter[3];
  block.grey = static_cast<uint8_t>(sum / (kPx * kPx));
  block.range = static_cast<uint8_t>((most - least) / (kHalf * kHalf));
}

}  // namespace

void DepthBlocks::build(const cv::Mat& disparity16, const cv::Mat& grey) {
  rows_ = disparity16.rows / kPx;
  cols_ = disparity16.cols / kPx;
  blocks_.assign(static_cast<size_t>(rows_ * cols_), {});
  for (int row = 0; row < rows_; ++row) {
    for (int col = 0; col < cols_; ++col) {
      read_disparity(disparity16, row, col, at(row, col));
      if (!grey.empty()) read_grey(grey, row, col, at(row, col));
    }
  }
}

double DepthBlocks::share(DepthBlock::Kind kind) const {
  if (blocks_.empty()) return 0.0;
  return static_cast<double>(std::ranges::count(blocks_, kind, &DepthBlock::kind)) /
         static_cast<double>(blocks_.size());
}

namespace {

constexpr double kSupportM = 25.0;        ///< least depth of the ground below the horizon
constexpr double kSupportRad = 0.16;      ///< below the horizon, within which the ground must have been matched
constexpr double kAttitudeRad = 0.03;     ///< by which the predicted horizon may err
constexpr int kSmooth = 6;                ///< grey levels within a block of sky and from one to the next
constexpr int kLikeOthers = 15;           ///< grey levels between a row's blocks of sky: skies brighten towards the sun

/// A column of blocks, climbed from the ground below the horizon.
class Column {
 public:
  Column(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks, int col)
      : geometry_(geometry), down_C_(down_C), blocks_(blocks), col_(col) {}

  /// Rows [top, bottom] that look like sky and what lies between it and the ground; the blocks of [top, horizon] are
  /// above the horizon for certain.
  struct Run {
    int top, horizon, bottom;
  };

  std::optional<Run> climb() const {
    const double far16 = geometry_.disparity16(kSupportM), near_rad = kAttitudeRad + 0.5 * kPx / geometry_.focal_px;
    int row = blocks_.rows() - 1;
    while (row >= 0 && elevation(row) < -kSupportRad) --row;
    // The topmost block of ground that was matched far away, nothing near above it.
    int support = -1;
    for (; row >= 0 && elevation(row) < near_rad; --row) {
      const DepthBlock& block = blocks_.at(row, col_);
      if (block.near16 > far16) {
        support = -1;
      } else if (block.kind == DepthBlock::Kind::matched) {
        support = row;
      }
    }
    if (support < 0 || row < 0) return std::nullopt;
    // Above the horizon all is smooth.
    Run run{row + 1, row, support - 1};
    for (; row >= 0; --row) {
      const DepthBlock& block = blocks_.at(row, col_);
      const bool steps = row < run.horizon && std::abs(block.grey - blocks_.at(row + 1, col_).grey) > kSmooth;
      if (block.near16 >= 0 || block.range > kSmooth || steps) break;
      run.top = row;
    }
    if (run.top > run.horizon) return std::nullopt;
    return run;
  }

 private:
  /// Sine of a block's elevation above the horizon.
  double elevation(int row) const {
    const cv::Point middle(col_ * kPx + kPx / 2, row * kPx + kPx / 2);
    return -down_C_.dot(geometry_.ray(middle).normalized());
  }

  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  const DepthBlocks& blocks_;
  int col_;
};

/// The median grey of the blocks that look like sky in each row; -1 where there are none.
std::vector<int> usual_greys(const DepthBlocks& blocks, const std::vector<std::optional<Column::Run>>& runs) {
  std::vector<int> usual(static_cast<size_t>(blocks.rows()), -1), greys;
  for (int row = 0; row < blocks.rows(); ++row) {
    greys.clear();
    for (int col = 0; col < blocks.cols(); ++col) {
      const auto& run = runs[static_cast<size_t>(col)];
      if (run && row >= run->top && row <= run->horizon) greys.push_back(blocks.at(row, col).grey);
    }
    if (greys.empty()) continue;
    const auto middle = greys.begin() + static_cast<std::ptrdiff_t>(greys.size() / 2);
    std::nth_element(greys.begin(), middle, greys.end());
    usual[static_cast<size_t>(row)] = *middle;
  }
  return usual;
}

}  // namespace

int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks) {
  std::vector<std::optional<Column::Run>> runs;
  for (int col = 0; col < blocks.cols(); ++col) runs.push_back(Column(geometry, down_C, blocks, col).climb());
  const std::vector<int> usual = usual_greys(blocks, runs);
  int found = 0;
  for (int col = 0; col < blocks.cols(); ++col) {
    const auto& run = runs[static_cast<size_t>(col)];
    if (!run) continue;
    for (int row = run->horizon; row >= run->top; --row) {
      DepthBlock& block = blocks.at(row, col);
      if (std::abs(block.grey - usual[static_cast<size_t>(row)]) > kLikeOthers) break;
      block.kind = DepthBlock::Kind::sky;
      ++found;
    }
    if (blocks.at(run->horizon, col).kind != DepthBlock::Kind::sky) continue;
    for (int row = run->horizon + 1; row <= run->bottom; ++row) {
      DepthBlock& block = blocks.at(row, col);
      if (block.kind != DepthBlock::Kind::unknown) continue;
      block.kind = DepthBlock::Kind::sky;
      ++found;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::mapping
