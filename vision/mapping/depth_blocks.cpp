#include "vision/mapping/depth_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace hedgehop::vision::mapping {
namespace {

constexpr int kPx = DepthBlocks::kBlockPx;

/// The largest disparity but for a share of the block's matched pixels: single wrong ones come nearer, too.
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
  const auto rank = matched.begin() + std::max(2, count / 8);
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

constexpr double kSupportM = 25.0;           ///< least depth of the ground below the horizon
constexpr double kNearHorizonRad = 0.05;     ///< of the edge between ground and sky: attitude errs by half a degree
constexpr double kSupportRad = 0.16;         ///< below the horizon, within which the ground must have been matched
constexpr int kSmooth = 6;                   ///< grey levels within a block and from one to the next
constexpr int kLikeOthers = 25;              ///< grey levels between columns: skies brighten towards the sun

/// Sine of a block's elevation above the horizon.
double elevation(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, int row, int col) {
  const cv::Point middle(col * kPx + kPx / 2, row * kPx + kPx / 2);
  return -down_C.dot(geometry.ray(middle).normalized());
}

/// Rows of a column that look like sky, from the lowest up: [first, last], first >= last.
struct Run {
  int lowest, highest, above_horizon;
};

/// Climbs a column from its ground to the horizon and on through what is smooth.
std::optional<Run> climb(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C,
                         const DepthBlocks& blocks, int col) {
  // The topmost matched block of the ground below the horizon.
  const double far16 = geometry.disparity16(kSupportM);
  int row = blocks.rows() - 1;
  while (row >= 0 && elevation(geometry, down_C, row, col) < -kSupportRad) --row;
  int support = -1;
  for (; row >= 0 && elevation(geometry, down_C, row, col) < kNearHorizonRad; --row) {
    const DepthBlock& block = blocks.at(row, col);
    if (block.near16 < 0) continue;
    if (block.near16 > far16) return std::nullopt;
    if (block.kind == DepthBlock::Kind::matched) support = row;
  }
  if (support <= 0) return std::nullopt;
  // From there: one edge at most, near the horizon.
  Run run{support - 1, support, -1};
  int edges = 0;
  for (row = support - 1; row >= 0; --row) {
    const DepthBlock& block = blocks.at(row, col);
    const double rises = elevation(geometry, down_C, row, col);
    if (block.near16 >= 0) {
      if (rises > kNearHorizonRad || block.near16 > far16) break;
      continue;
    }
    const bool edge = row < support - 1 && std::abs(block.grey - blocks.at(row + 1, col).grey) > kSmooth;
    if (edge || block.range > kSmooth) {
      if (std::abs(rises) > kNearHorizonRad) break;
      ++edges;  // one edge crosses two blocks or three
    }
    if (edges > 3) break;
    run.highest = row;
    if (run.above_horizon < 0 && rises > kNearHorizonRad) run.above_horizon = block.grey;
  }
  if (run.highest > run.lowest || run.above_horizon < 0) return std::nullopt;
  return run;
}

}  // namespace

int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks) {
  std::vector<std::optional<Run>> runs;
  std::vector<int> greys;
  for (int col = 0; col < blocks.cols(); ++col) {
    runs.push_back(climb(geometry, down_C, blocks, col));
    if (runs.back()) greys.push_back(runs.back()->above_horizon);
  }
  if (greys.empty()) return 0;
  std::ranges::nth_element(greys, greys.begin() + static_cast<std::ptrdiff_t>(greys.size() / 2));
  const int usual = greys[greys.size() / 2];
  int found = 0;
  for (int col = 0; col < blocks.cols(); ++col) {
    const std::optional<Run>& run = runs[static_cast<size_t>(col)];
    if (!run || std::abs(run->above_horizon - usual) > kLikeOthers) continue;
    for (int row = run->highest; row <= run->lowest; ++row) {
      DepthBlock& block = blocks.at(row, col);
      if (block.kind == DepthBlock::Kind::matched) continue;
      block.kind = DepthBlock::Kind::sky;
      ++found;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::mapping
