#include "vision/mapping/find_plain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "vision/mapping/ground_plane.h"
#include "vision/mapping/upright_columns.h"

namespace hedgehop::vision::mapping {
namespace {

constexpr int kPlainPx = DepthBlocks::kBlockPx;
constexpr int kEdgeBlocks = 3;     ///< maximum blocks between ground and plain surface
constexpr int kPlainRange = 4;     ///< maximum grey difference within a block and to the next; noise gives about 2
constexpr int kFootStep = 6;       ///< minimum grey difference of the ground from the surface at its foot
constexpr int kUnmatchedRows = 8;  ///< maximum successive unmatched rows of pixels between foot and certain ground
constexpr int kFootRows = 3;       ///< rows of pixels that differ, because single rows are noisy
constexpr double kHorizon = 0.03;  ///< sine of the elevation of blocks that are certainly above the horizon

/// Rows [top, bottom] of a column that show a plain surface.
struct PlainRun {
  int top, bottom;
  double foot_m;  ///< horizontal distance of the ground at its foot
  bool stands;
};

/// Examines upright columns for plain surfaces.
class PlainSearch {
 public:
  PlainSearch(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const GroundPlane& ground,
              const cv::Mat& disparity16, const cv::Mat& grey)
      : geometry_(geometry), down_C_(down_C), ground_(ground), disparity16_(disparity16), grey_(grey) {}

  /// Returns whether a block shows ground, or matches that continue the ground.
  bool is_on_ground(const UprightColumn& column, int row) const {
    return ground_.contains(column.at(row), lower_border_ray(geometry_, row, column.col(row)));
  }

  /// Examines a column upward from the ground at the lower border of the image.
  std::optional<PlainRun> find_run(const UprightColumn& column) const {
    const int lowest = column.lowest();
    int support = lowest + 1, certain = support;  // topmost ground, and topmost that is not smeared over the surface
    for (int row = lowest; row >= 0 && column.in_image(row) && support - row <= GroundPlane::kMaxGap + 1; --row) {
      if (!is_on_ground(column, row)) continue;
      support = row;
      if (column.at(row).kind == DepthBlock::Kind::matched) certain = row;
    }
    if (certain > lowest) return std::nullopt;
    int row = support - 1;
    for (; row >= 0 && support - row <= kEdgeBlocks && column.in_image(row) && !is_smooth(column.at(row)); --row) {
      if (column.at(row).near16 >= 0) return std::nullopt;  // an object
    }
    if (row < 0 || support - row > kEdgeBlocks || !column.in_image(row)) return std::nullopt;
    const std::optional<Foot> foot = find_foot(column, row, certain);
    if (!foot || foot->distance_m <= 0.0) return std::nullopt;
    PlainRun run{row + 1, row, foot->distance_m, false};
    for (int below = column.at(row).grey; row >= 0 && column.in_image(row); --row) {
      const DepthBlock& block = column.at(row);
      if (!is_smooth(block) || std::abs(block.grey - below) > kPlainRange) break;
      run.top = row;
      below = block.grey;
    }
    if (row >= 0 && column.in_image(row)) ++run.top;  // part of the edge may be in the block below it
    if (run.top > run.bottom) return std::nullopt;
    run.stands = foot->is_edge && column.in_image(run.top) && column.elevation(run.top) > kHorizon;
    return run;
  }

 private:
  struct Foot {
    double distance_m;  ///< horizontal
    bool is_edge;       ///< otherwise the surface begins farther away
  };

  static bool is_smooth(const DepthBlock& block) {
    return block.near16 < 0 && block.range <= kPlainRange && !block.lined && block.kind != DepthBlock::Kind::line;
  }

  /// Searches downward from a block of the surface for the first rows of pixels of another brightness, in both halves
  /// of the block, because the foot of a wall along the view is oblique. Ground must begin there; otherwise it is the
  /// lower edge of an object in the air. If there are no such rows down to certain ground, that ground is the foot.
  std::optional<Foot> find_foot(const UprightColumn& column, int surface, int certain) const {
    const int last = std::min((certain + 1) * kPlainPx, grey_.rows) - 1;
    const int wall = column.at(surface).grey;
    for (int v = (surface + 1) * kPlainPx; v + kFootRows - 1 <= last; ++v) {
      const int row = v / kPlainPx;
      if (!column.in_image(row)) break;
      const int u = column.col(row) * kPlainPx;
      if (!differs(wall, u, v) || !differs(wall, u + kPlainPx / 2, v)) continue;
      if (!is_ground(column, v, last)) return std::nullopt;
      return Foot{distance_m(column.col(row), v), true};
    }
    return Foot{distance_m(column.col(certain), last), false};
  }

  /// Returns whether the rows of pixels [first, last] are matched as ground, except for a few.
  bool is_ground(const UprightColumn& column, int first, int last) const {
    for (int v = first, unmatched = 0; v <= last; ++v) {
      const int row = v / kPlainPx;
      if (!column.in_image(row)) return false;
      int matched = 0;
      for (int i = 0; i < kPlainPx; ++i) {
        const int u = column.col(row) * kPlainPx + i;
        const int d16 = disparity16_.at<int16_t>(v, u);
        matched += d16 >= 0 &&
                   std::abs(d16 - ground_.disparity16(geometry_.ray_at_unit_depth({u, v}))) <= GroundPlane::kWithin16;
      }
      unmatched = matched >= kPlainPx / 2 ? 0 : unmatched + 1;
      if (unmatched > kUnmatchedRows) return false;
    }
    return true;
  }

  /// Returns whether the pixels of half a block's width, in a few rows from v down, have another mean than a surface.
  bool differs(int wall, int u, int v) const {
    constexpr int kCount = kFootRows * kPlainPx / 2;
    int sum = 0;
    for (int row = v; row < v + kFootRows; ++row) {
      for (int i = 0; i < kPlainPx / 2; ++i) sum += grey_.at<uint8_t>(row, u + i);
    }
    return std::abs(sum - wall * kCount) > kFootStep * kCount;
  }

  /// Returns the horizontal distance of the ground at a pixel in the middle of a block's columns; 0 if there is none.
  double distance_m(int col, int v) const {
    const Eigen::Vector3d ray_C = geometry_.ray_at_unit_depth({col * kPlainPx + kPlainPx / 2, v});
    const double disparity16 = ground_.disparity16(ray_C);
    return disparity16 <= 0.0 ? 0.0 : ray_C.cross(down_C_).norm() * geometry_.disparity16(1.0) / disparity16;
  }

  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  const GroundPlane& ground_;
  const cv::Mat &disparity16_, &grey_;
};

/// A sequence of adjacent columns whose plain surfaces continue each other.
struct PlainGroup {
  int first, last;  ///< columns
};

/// The runs of all columns.
class PlainRuns {
 public:
  PlainRuns(const UprightColumns& columns, const PlainSearch& search) : columns_(columns.all()), search_(search) {
    for (const UprightColumn& column : columns_) runs_.push_back(search.find_run(column));
  }

  const std::optional<PlainRun>& at(int column) const { return runs_[static_cast<size_t>(column)]; }

  /// Removes surfaces whose sides are matched nearer than their feet: they hang in the air, and the ground seems to end
  /// at their lower edge.
  void remove_hanging() {
    for (const PlainGroup& group : groups()) {
      if (!is_nearer(group.first, -1) && !is_nearer(group.last, 1)) continue;
      for (int column = group.first; column <= group.last; ++column) runs_[static_cast<size_t>(column)].reset();
    }
  }

 private:
  static constexpr int kAsideColumns = 3;     ///< columns of blocks with the side of a surface
  static constexpr int kBeyondColumns = 6;    ///< columns with the surface to which a side belongs
  static constexpr double kNearer16 = 32.0;   ///< difference of disparity of other surfaces: four sigma
  static constexpr int kNearerBlocks = 2;     ///< minimum evidence for a side
  static constexpr double kContinues = 0.15;  ///< maximum relative difference of the distance of adjacent columns

  bool is_column(int column) const { return column >= 0 && column < static_cast<int>(runs_.size()); }
  const UprightColumn& column(int index) const { return columns_[static_cast<size_t>(index)]; }

  std::vector<PlainGroup> groups() const {
    std::vector<PlainGroup> groups;
    for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
      if (!at(i)) continue;
      const bool continues = !groups.empty() && groups.back().last == i - 1 &&
                             std::abs(at(i)->foot_m - at(i - 1)->foot_m) < kContinues * at(i)->foot_m;
      if (continues) {
        groups.back().last = i;
      } else {
        groups.push_back({i, i});
      }
    }
    return groups;
  }

  /// Returns whether the side of a surface at its last column is nearer than its foot. @param aside  direction, 1 or
  /// -1.
  bool is_nearer(int last, int aside) const {
    const PlainRun& run = *at(last);
    int nearer = 0;
    for (int i = last + aside; is_column(i) && std::abs(i - last) <= kAsideColumns; i += aside) {
      for (int row = run.top; row <= run.bottom; ++row) {
        if (!column(i).in_image(row) || search_.is_on_ground(column(i), row)) continue;
        const int near16 = column(i).at(row).near16;
        if (near16 < column(last).upright16(row, run.foot_m) + kNearer16) continue;
        nearer += !belongs_beyond(i, aside, row, near16);
      }
    }
    return nearer >= kNearerBlocks;
  }

  /// Returns whether a match belongs to another surface, plain or textured, farther aside.
  bool belongs_beyond(int from, int aside, int row, int near16) const {
    int matched = 0;
    for (int i = from + aside; is_column(i) && std::abs(i - from) <= kBeyondColumns; i += aside) {
      if (!column(i).in_image(row)) continue;
      const std::optional<PlainRun>& other = at(i);
      if (other && std::abs(column(i).upright16(row, other->foot_m) - near16) < kNearer16) return true;
      const DepthBlock& block = column(i).at(row);
      matched += block.kind == DepthBlock::Kind::matched && std::abs(block.near16 - near16) < kNearer16;
    }
    return matched > 1;
  }

  const std::vector<UprightColumn>& columns_;
  const PlainSearch& search_;
  std::vector<std::optional<PlainRun>> runs_;  ///< of each column
};

}  // namespace

int find_plain(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const cv::Mat& disparity16,
               const cv::Mat& grey, DepthBlocks& blocks) {
  const UprightColumns columns(geometry, down_C, blocks);
  const std::optional<GroundPlane> ground = fit_ground(geometry, down_C, columns);
  if (!ground) return 0;
  const PlainSearch search(geometry, down_C, *ground, disparity16, grey);
  PlainRuns runs(columns, search);
  runs.remove_hanging();
  int found = 0;
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      DepthBlock& block = blocks.at(row, col);
      if (block.kind != DepthBlock::Kind::unknown || block.near16 >= 0) continue;
      const int of = columns.of(row, col);
      if (of < 0 || !runs.at(of)) continue;
      const PlainRun& run = *runs.at(of);
      if (row < run.top || row > run.bottom) continue;
      block.kind = DepthBlock::Kind::plain;
      block.stands = run.stands;
      block.foot16 = static_cast<int16_t>(columns.all()[static_cast<size_t>(of)].upright16(row, run.foot_m));
      ++found;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::mapping
