#include "vision/mapping/depth_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/order_statistics.h"

namespace hedgehop::vision::mapping {
namespace {

constexpr int kBlockPx = DepthBlocks::kBlockPx;
constexpr double kSupportM = 25.0;     ///< least distance to the ground's end, in this column or near it, level
constexpr size_t kSupportCols = 6;     ///< how near
constexpr double kOwnM = 15.0;         ///< least distance in the column itself
constexpr int kGap = 2;                ///< blocks of the ground, one above the other, that need not be matched
constexpr double kAttitudeRad = 0.03;  ///< by which the predicted horizon may err
constexpr int kLines = 3;              ///< blocks of a column with something thin in them
constexpr int kSmooth = 6;             ///< grey levels within a block of sky and from one to the next
constexpr int kLikeOthers = 15;        ///< grey levels between a row's blocks of sky: skies brighten towards the sun

cv::Point middle_px(int row, int col) { return {col * kBlockPx + kBlockPx / 2, row * kBlockPx + kBlockPx / 2}; }

/// The block of a row that a vertical plane through C meets; may lie beside the image. @param across_C  its normal.
int upright_col(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& across_C, int row) {
  constexpr double kFarBeside = 1e6;  // where the row runs along the plane
  const double y = geometry.ray_at_unit_depth(middle_px(row, 0)).y();
  const double x = -(across_C.y() * y + across_C.z()) / across_C.x();
  const double col = (geometry.center_u_px + geometry.focal_px * x) / kBlockPx;
  return std::abs(col) < kFarBeside ? static_cast<int>(std::floor(col)) : -1;
}

/// Blocks, one in each row, that show what is upright in the world, climbed from the ground below the horizon.
class Column {
 public:
  /// @param col  of its block in the middle row; may lie beside the image, into which a tilted one still leads.
  Column(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks, int col)
      : geometry_(geometry), down_C_(down_C), blocks_(blocks) {
    const Eigen::Vector3d across_C = down_C.cross(geometry.ray_at_unit_depth(middle_px(blocks.rows() / 2, col)));
    for (int row = 0; row < blocks.rows(); ++row) cols_.push_back(upright_col(geometry, across_C, row));
  }

  /// Rows [top, bottom] that look like sky and what lies between it and the ground; the blocks of [top, horizon] are
  /// above the horizon for certain.
  struct SkyRun {
    int top, horizon, bottom;
    double foot_m;  ///< level distance of the topmost ground, and of what stands on it
  };

  bool in_image(int row) const { return cols_[row_index(row)] >= 0 && cols_[row_index(row)] < blocks_.cols(); }
  const DepthBlock& at(int row) const { return blocks_.at(row, cols_[row_index(row)]); }

  std::optional<SkyRun> climb() const {
    const double near_rad = kAttitudeRad + 0.5 * kBlockPx / geometry_.focal_px;
    int row = blocks_.rows() - 1;
    while (row >= 0 && !in_image(row)) --row;
    // The topmost block of the ground, which is matched from the image's edge on: what is matched beyond a gap may be
    // noise on a wall.
    const int lowest = row;
    int support = lowest + 1;
    for (; row >= 0 && in_image(row) && elevation(row) < near_rad; --row) {
      if (at(row).kind == DepthBlock::Kind::unknown) continue;
      if (support - row > kGap + 1) return std::nullopt;
      support = row;
    }
    if (support > lowest || row < 0 || !in_image(row)) return std::nullopt;
    double foot_m = level_m(support);
    if (foot_m < kOwnM) return std::nullopt;
    // Above the horizon what was matched as far as the ground must be, with its edge; from there on all is smooth.
    for (bool edge = true; row >= 0 && in_image(row); --row) {
      const DepthBlock& block = at(row);
      const bool stands = block.near16 >= 0 && level_m(row) >= kOwnM;
      if (!stands && (!edge || block.near16 >= 0 || block.range <= kSmooth)) break;
      if (stands) foot_m = std::min(foot_m, level_m(row));
      edge = stands;  // one block of it
    }
    SkyRun run{row + 1, row, support - 1, foot_m};
    int below = -1, lines = 0;  // the grey of the last block of sky
    for (; row >= 0 && in_image(row); --row) {
      const DepthBlock& block = at(row);
      if (block.lined && block.kind == DepthBlock::Kind::unknown && lines++ < kLines) {
        run.top = row;
        continue;
      }
      const bool steps = below >= 0 && std::abs(block.grey - below) > kSmooth;
      if (block.near16 >= 0 || block.range > kSmooth || steps) break;
      run.top = row;
      below = block.grey;
    }
    if (run.top > run.horizon) return std::nullopt;
    return run;
  }

  /// Disparity x 16 of what stands upright at a level distance, where a block shows it.
  int upright16(int row, double distance_m) const {
    return static_cast<int>(std::ceil(geometry_.disparity16(distance_m / level(row))));
  }

 private:
  static size_t row_index(int row) { return static_cast<size_t>(row); }
  Eigen::Vector3d ray(int row) const { return geometry_.ray_at_unit_depth(middle_px(row, cols_[row_index(row)])); }
  /// Sine of a block's elevation above the horizon.
  double elevation(int row) const { return -down_C_.dot(ray(row).normalized()); }
  /// Level distance of what a block shows, per z in C.
  double level(int row) const { return ray(row).cross(down_C_).norm(); }
  double level_m(int row) const { return level(row) * geometry_.z_m(at(row).near16); }

  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  const DepthBlocks& blocks_;
  std::vector<int> cols_;  ///< of each row
};

/// A column that may show sky, and where.
struct SkyCandidate {
  Column column;
  std::optional<Column::SkyRun> run;
};

/// The median grey of each row's blocks in the runs that have far ground beside them; -1 where there are none.
std::vector<int> usual_greys(int rows, const std::vector<SkyCandidate>& candidates) {
  const auto is_far_near = [&](size_t i) {
    const size_t first = i > kSupportCols ? i - kSupportCols : 0;
    const size_t last = std::min(candidates.size(), i + kSupportCols + 1);
    return std::any_of(candidates.begin() + static_cast<std::ptrdiff_t>(first),
                       candidates.begin() + static_cast<std::ptrdiff_t>(last),
                       [](const SkyCandidate& c) { return c.run && c.run->foot_m >= kSupportM; });
  };
  std::vector<std::vector<int>> greys(static_cast<size_t>(rows));
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto& [column, run] = candidates[i];
    if (!run || !is_far_near(i)) continue;
    for (int row = run->top; row <= run->horizon; ++row) {
      if (!column.at(row).lined) greys[static_cast<size_t>(row)].push_back(column.at(row).grey);
    }
  }
  std::vector<int> usual;
  for (std::vector<int>& of_row : greys) {
    usual.push_back(of_row.empty() ? -1 : upper_median(of_row));
  }
  return usual;
}

}  // namespace

int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks) {
  // Tilted by half a right angle, columns enter from as many blocks beside the image as it has rows.
  const int beside = blocks.rows(), middle = blocks.rows() / 2;
  std::vector<SkyCandidate> candidates;
  for (int col = -beside; col < blocks.cols() + beside; ++col) {
    const Column column(geometry, down_C, blocks, col);
    candidates.push_back({column, column.climb()});
  }
  const std::vector<int> usual = usual_greys(blocks.rows(), candidates);
  for (auto& [column, run] : candidates) {
    if (!run) continue;
    for (int row = run->top; row <= run->horizon; ++row) {
      const int grey = usual[static_cast<size_t>(row)];
      if (column.at(row).lined || (grey >= 0 && std::abs(column.at(row).grey - grey) <= kLikeOthers)) continue;
      run.reset();
      break;
    }
  }
  int found = 0;
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      DepthBlock& block = blocks.at(row, col);
      if (block.kind == DepthBlock::Kind::matched) continue;
      const int of =
          beside + upright_col(geometry, down_C.cross(geometry.ray_at_unit_depth(middle_px(row, col))), middle);
      if (of < 0 || of >= static_cast<int>(candidates.size())) continue;
      const auto& [column, run] = candidates[static_cast<size_t>(of)];
      if (!run || row < run->top || row > run->bottom) continue;
      block.kind = block.lined ? DepthBlock::Kind::line : DepthBlock::Kind::sky;
      block.foot16 = static_cast<int16_t>(column.upright16(row, run->foot_m));
      found += !block.lined;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::mapping
