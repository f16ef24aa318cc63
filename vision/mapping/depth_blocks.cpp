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

constexpr double kSupportM = 25.0;     ///< least distance to the ground's end, in this column or near it, level
constexpr int kSupportCols = 6;        ///< how near
constexpr double kOwnM = 15.0;         ///< least distance in the column itself
constexpr int kGap = 2;                ///< blocks of the ground, one above the other, that need not be matched
constexpr double kAttitudeRad = 0.03;  ///< by which the predicted horizon may err
constexpr int kSmooth = 6;             ///< grey levels within a block of sky and from one to the next
constexpr int kLikeOthers = 15;        ///< grey levels between a row's blocks of sky: skies brighten towards the sun

/// A column of blocks, climbed from the ground below the horizon.
class Column {
 public:
  Column(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks, int col)
      : geometry_(geometry), down_C_(down_C), blocks_(blocks), col_(col) {}

  /// Rows [top, bottom] that look like sky and what lies between it and the ground; the blocks of [top, horizon] are
  /// above the horizon for certain.
  struct Run {
    int top, horizon, bottom;
    double foot_m;  ///< level distance of the topmost ground, and of what stands on it
  };

  std::optional<Run> climb() const {
    const double near_rad = kAttitudeRad + 0.5 * kPx / geometry_.focal_px;
    int row = blocks_.rows() - 1;
    // The topmost block of the ground, which is matched from the image's lower edge on: what is matched beyond a gap
    // may be noise on a wall.
    int support = blocks_.rows();
    for (; row >= 0 && elevation(row) < near_rad; --row) {
      if (blocks_.at(row, col_).kind != DepthBlock::Kind::matched) continue;
      if (support - row > kGap + 1) return std::nullopt;
      support = row;
    }
    if (support == blocks_.rows() || row < 0) return std::nullopt;
    double foot_m = level_m(support);
    if (foot_m < kOwnM) return std::nullopt;
    // Above the horizon what was matched as far as the ground must be, with its edge; from there on all is smooth.
    for (bool edge = true; row >= 0; --row) {
      const DepthBlock& block = blocks_.at(row, col_);
      const bool stands = block.near16 >= 0 && level_m(row) >= kOwnM;
      if (!stands && (!edge || block.near16 >= 0 || block.range <= kSmooth)) break;
      if (stands) foot_m = std::min(foot_m, level_m(row));
      edge = stands;  // one block of it
    }
    Run run{row + 1, row, support - 1, foot_m};
    for (; row >= 0; --row) {
      const DepthBlock& block = blocks_.at(row, col_);
      const bool steps = row < run.horizon && std::abs(block.grey - blocks_.at(row + 1, col_).grey) > kSmooth;
      if (block.near16 >= 0 || block.range > kSmooth || steps) break;
      run.top = row;
    }
    if (run.top > run.horizon) return std::nullopt;
    return run;
  }

  /// Disparity x 16 of what stands upright at a level distance, where a block shows it.
  int upright16(int row, double distance_m) const {
    return static_cast<int>(std::ceil(geometry_.disparity16(distance_m / level(row))));
  }

 private:
  Eigen::Vector3d ray(int row) const { return geometry_.ray({col_ * kPx + kPx / 2, row * kPx + kPx / 2}); }
  /// Sine of a block's elevation above the horizon.
  double elevation(int row) const { return -down_C_.dot(ray(row).normalized()); }
  /// Level distance of what a block shows, per z in C.
  double level(int row) const { return ray(row).cross(down_C_).norm(); }
  double level_m(int row) const { return level(row) * geometry_.z_m(blocks_.at(row, col_).near16); }

  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  const DepthBlocks& blocks_;
  int col_;
};

/// The median grey of each row's blocks in the runs given; -1 where there are none.
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
  std::vector<Column> columns;
  std::vector<std::optional<Column::Run>> runs;
  for (int col = 0; col < blocks.cols(); ++col) {
    columns.emplace_back(geometry, down_C, blocks, col);
    runs.push_back(columns.back().climb());
  }
  const auto is_far_near = [&](int col) {
    const auto first = runs.begin() + std::max(0, col - kSupportCols);
    const auto last = runs.begin() + std::min(blocks.cols(), col + kSupportCols + 1);
    return std::any_of(first, last, [](const auto& run) { return run && run->foot_m >= kSupportM; });
  };
  std::vector<std::optional<Column::Run>> far = runs;
  for (int col = 0; col < blocks.cols(); ++col) {
    if (!is_far_near(col)) far[static_cast<size_t>(col)].reset();
  }
  const std::vector<int> usual = usual_greys(blocks, far);
  int found = 0;
  for (int col = 0; col < blocks.cols(); ++col) {
    const auto& run = runs[static_cast<size_t>(col)];
    if (!run) continue;
    const auto is_unlike = [&](int row) {
      const int grey = usual[static_cast<size_t>(row)];
      return grey < 0 || std::abs(blocks.at(row, col).grey - grey) > kLikeOthers;
    };
    bool like_sky = true;
    for (int row = run->top; row <= run->horizon && like_sky; ++row) like_sky = !is_unlike(row);
    if (!like_sky) continue;
    for (int row = run->top; row <= run->bottom; ++row) {
      DepthBlock& block = blocks.at(row, col);
      if (block.kind != DepthBlock::Kind::unknown) continue;
      block.kind = DepthBlock::Kind::sky;
      block.foot16 = static_cast<int16_t>(columns[static_cast<size_t>(col)].upright16(row, run->foot_m));
      ++found;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::mapping
