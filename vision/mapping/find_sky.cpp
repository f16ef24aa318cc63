#include "vision/mapping/depth_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/fields/order_statistics.h"
#include "vision/mapping/ground_plane.h"
#include "vision/mapping/upright_columns.h"

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

/// Rows [top, bottom] of an upright column that appear to be sky or are between sky and ground. The blocks of
/// [top, horizon] are certainly above the horizon.
struct SkyRun {
  int top, horizon, bottom;
  double foot_m;  ///< horizontal distance of the topmost ground and of objects on it
};

/// Searches upward for ground beyond a plain surface that hides the ground in front of it, such as a wall below a
/// window: successive blocks matched on the plane of the ground, next to the upper edge of the surface.
/// @param row  lowest row of the surface or of its foot. @return the first row of the ground; -1 if there is none.
int ground_beyond(const stereo::StereoGeometry& geometry, const GroundPlane& ground, const UprightColumn& column,
                  int row) {
  constexpr int kEdgeRows = 3, kMinPlainRows = 3, kGroundRows = 4;
  const int first = row;
  int plain = 0;
  for (int below = 0; row >= 0 && column.in_image(row); --row) {
    const DepthBlock& block = column.at(row);
    const bool is_plain =
        block.near16 < 0 && block.range <= kSmooth && (plain == 0 || std::abs(block.grey - below) <= kSmooth);
    if (!is_plain && (plain > 0 || first - row >= kEdgeRows)) break;
    plain += is_plain;
    below = block.grey;
  }
  if (plain < kMinPlainRows) return -1;
  const auto is_ground = [&](int at) {
    return at >= 0 && column.in_image(at) && column.at(at).kind == DepthBlock::Kind::matched &&
           ground.contains(column.at(at), lower_border_ray(geometry, at, column.col(at)));
  };
  for (int edge = 0; edge < kEdgeRows && !is_ground(row); ++edge) --row;
  for (int i = 0; i < kGroundRows; ++i) {
    if (!is_ground(row - i)) return -1;
  }
  return row;
}

/// Examines a column upward from the ground below the horizon. @param ground  null if its plane is not known.
std::optional<SkyRun> find_run(const stereo::StereoGeometry& geometry, const GroundPlane* ground,
                               const UprightColumn& column) {
  const double near_rad = kAttitudeRad + 0.5 * kBlockPx / geometry.focal_px;
  // Find the topmost block of the ground, which is matched from the image's border upward. A match beyond a gap may
  // be noise on a wall.
  const int lowest = column.lowest();
  int row = lowest, support = lowest + 1;
  for (; row >= 0 && column.in_image(row) && column.elevation(row) < near_rad; --row) {
    if (column.at(row).kind == DepthBlock::Kind::unknown) continue;
    if (support - row > kGap + 1) {
      row = ground ? ground_beyond(geometry, *ground, column, support - 1) : -1;
      if (row < 0) return std::nullopt;
    }
    support = row;
  }
  if (support > lowest || row < 0 || !column.in_image(row)) return std::nullopt;
  double foot_m = column.horizontal_m(support);
  if (foot_m < kOwnM) return std::nullopt;
  // Above the horizon, skip matches at the distance of the ground and the edge block on top of them. All blocks above
  // must be smooth.
  for (bool edge = true; row >= 0 && column.in_image(row); --row) {
    const DepthBlock& block = column.at(row);
    const bool is_object = block.near16 >= 0 && column.horizontal_m(row) >= kOwnM;
    if (!is_object && (!edge || block.near16 >= 0 || block.range <= kSmooth)) break;
    if (is_object) foot_m = std::min(foot_m, column.horizontal_m(row));
    edge = is_object;  // one edge block
  }
  SkyRun run{row + 1, row, support - 1, foot_m};
  int below = -1, lines = 0;  // grey of the last sky block
  for (; row >= 0 && column.in_image(row); --row) {
    const DepthBlock& block = column.at(row);
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

/// A column and its rows that may be sky.
struct SkyCandidate {
  const UprightColumn& column;
  std::optional<SkyRun> run;
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

int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks,
             const GroundPlane* ground) {
  const UprightColumns columns(geometry, down_C, blocks);
  std::vector<SkyCandidate> candidates;
  for (const UprightColumn& column : columns.all()) {
    candidates.push_back({column, find_run(geometry, ground, column)});
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
      const int of = columns.of(row, col);
      if (of < 0) continue;
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
