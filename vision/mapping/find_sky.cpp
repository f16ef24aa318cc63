#include "vision/mapping/depth_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "sim/fields/order_statistics.h"

namespace hedgehop::vision::mapping {
namespace {

constexpr int kBlockPx = DepthBlocks::kBlockPx;
constexpr double kSupportM = 25.0;  ///< minimum horizontal distance to the end of the ground, in this column or near it
constexpr size_t kSupportCols = 6;  ///< columns that count as near
constexpr double kOwnM = 15.0;      ///< minimum distance in the column itself
constexpr int kGap = 2;             ///< maximum unmatched blocks within the ground of a column
constexpr double kAttitudeRad = 0.03;  ///< error of the predicted horizon
constexpr int kLines = 3;              ///< maximum blocks of a column with a thin object
constexpr int kSmooth = 6;             ///< maximum grey difference within a block of sky and to the next one
constexpr int kLikeOthers = 15;        ///< maximum grey difference of sky in a row, which brightens towards the sun

cv::Point middle_px(int row, int col) { return {col * kBlockPx + kBlockPx / 2, row * kBlockPx + kBlockPx / 2}; }

/// Returns the column at which a vertical plane through C crosses one block row; it may be outside the image.
/// @param across_C  normal of the plane.
int upright_col(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& across_C, int row) {
  constexpr double kMaxCol = 1e6;  // exceeded if the row is parallel to the plane
  const double y = geometry.ray_at_unit_depth(middle_px(row, 0)).y();
  const double x = -(across_C.y() * y + across_C.z()) / across_C.x();
  const double col = (geometry.center_u_px + geometry.focal_px * x) / kBlockPx;
  return std::abs(col) < kMaxCol ? static_cast<int>(std::floor(col)) : -1;
}

/// The blocks along a vertical line of the world, one per row, examined upward from the ground below the horizon.
class Column {
 public:
  /// @param col  of its block in the middle row; may be outside the image, which a tilted column still crosses.
  Column(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks, int col)
      : geometry_(geometry), down_C_(down_C), blocks_(blocks) {
    const Eigen::Vector3d across_C = down_C.cross(geometry.ray_at_unit_depth(middle_px(blocks.rows() / 2, col)));
    for (int row = 0; row < blocks.rows(); ++row) cols_.push_back(upright_col(geometry, across_C, row));
  }

  /// Rows [top, bottom] that appear to be sky or are between sky and ground. The blocks of [top, horizon] are certainly
  /// above the horizon.
  struct SkyRun {
    int top, horizon, bottom;
    double foot_m;  ///< horizontal distance of the topmost ground and of objects on it
  };

  bool in_image(int row) const { return cols_[row_index(row)] >= 0 && cols_[row_index(row)] < blocks_.cols(); }
  const DepthBlock& at(int row) const { return blocks_.at(row, cols_[row_index(row)]); }

  std::optional<SkyRun> find_run() const {
    const double near_rad = kAttitudeRad + 0.5 * kBlockPx / geometry_.focal_px;
    int row = blocks_.rows() - 1;
    while (row >= 0 && !in_image(row)) --row;
    // Find the topmost block of the ground, which is matched from the image's border upward. A match beyond a gap may
    // be noise on a wall.
    const int lowest = row;
    int support = lowest + 1;
    for (; row >= 0 && in_image(row) && elevation(row) < near_rad; --row) {
      if (at(row).kind == DepthBlock::Kind::unknown) continue;
      if (support - row > kGap + 1) return std::nullopt;
      support = row;
    }
    if (support > lowest || row < 0 || !in_image(row)) return std::nullopt;
    double foot_m = horizontal_m(support);
    if (foot_m < kOwnM) return std::nullopt;
    // Above the horizon, skip matches at the distance of the ground and the edge block on top of them. All blocks above
    // must be smooth.
    for (bool edge = true; row >= 0 && in_image(row); --row) {
      const DepthBlock& block = at(row);
      const bool is_object = block.near16 >= 0 && horizontal_m(row) >= kOwnM;
      if (!is_object && (!edge || block.near16 >= 0 || block.range <= kSmooth)) break;
      if (is_object) foot_m = std::min(foot_m, horizontal_m(row));
      edge = is_object;  // one edge block
    }
    SkyRun run{row + 1, row, support - 1, foot_m};
    int below = -1, lines = 0;  // grey of the last sky block
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

  /// Returns the disparity x 16, at the block of a row, of a vertical surface at a horizontal distance.
  int upright16(int row, double distance_m) const {
    return static_cast<int>(std::ceil(geometry_.disparity16(distance_m / horizontal_per_z(row))));
  }

 private:
  static size_t row_index(int row) { return static_cast<size_t>(row); }
  Eigen::Vector3d ray(int row) const { return geometry_.ray_at_unit_depth(middle_px(row, cols_[row_index(row)])); }
  /// Returns the sine of a block's elevation above the horizon.
  double elevation(int row) const { return -down_C_.dot(ray(row).normalized()); }
  /// Returns the horizontal distance of a point in a block divided by its z in C.
  double horizontal_per_z(int row) const { return ray(row).cross(down_C_).norm(); }
  double horizontal_m(int row) const { return horizontal_per_z(row) * geometry_.z_m(at(row).near16); }

  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  const DepthBlocks& blocks_;
  std::vector<int> cols_;  ///< of each row
};

/// A column and its rows that may be sky.
struct SkyCandidate {
  Column column;
  std::optional<Column::SkyRun> run;
};

/// Returns the median grey of each row over the runs near far ground; -1 for rows without such runs.
std::vector<int> median_greys(int rows, const std::vector<SkyCandidate>& candidates) {
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
  std::vector<int> medians;
  for (std::vector<int>& of_row : greys) {
    medians.push_back(of_row.empty() ? -1 : upper_median(of_row));
  }
  return medians;
}

}  // namespace

int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks) {
  // At a tilt of 45 degrees, columns enter the image from as many blocks outside it as it has rows.
  const int margin = blocks.rows(), middle = blocks.rows() / 2;
  std::vector<SkyCandidate> candidates;
  for (int col = -margin; col < blocks.cols() + margin; ++col) {
    const Column column(geometry, down_C, blocks, col);
    candidates.push_back({column, column.find_run()});
  }
  const std::vector<int> medians = median_greys(blocks.rows(), candidates);
  for (auto& [column, run] : candidates) {
    if (!run) continue;
    for (int row = run->top; row <= run->horizon; ++row) {
      const int grey = medians[static_cast<size_t>(row)];
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
          margin + upright_col(geometry, down_C.cross(geometry.ray_at_unit_depth(middle_px(row, col))), middle);
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
