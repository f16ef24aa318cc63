#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "vision/mapping/distance_field.h"
#include "vision/mapping/occupancy_map.h"

namespace hedgehop::avoidance::local_map {

/// Cells of the plane of flight that stay obstacles where the map knows nothing of them: what stayed unknown however
/// long it was looked at, as a plain wall does, and what was seen to be occupied and has left the map or its memory
/// since. What is seen to be free counts as free all the same. So a search goes on elsewhere, and ends. Ours: without
/// it, a planner that assumes unknown space to be free waits before a plain wall for ever, and tries a wall that is
/// longer than its map again and again.
class ClosedCells {
 public:
  static constexpr double kUnknownS = 90.0, kOccupiedS = 600.0;  ///< for how long they are kept

  /// @param cell_m  edge, > 0: that of the slice.
  explicit ClosedCells(double cell_m) : cell_m_(cell_m) {}

  /// Closes a disk at a height. @param t_s  now, rising.
  void close(const Eigen::Vector3d& p_W, double radius_m, double t_s);
  /// Closes one cell, seen to be occupied.
  void remember(const Eigen::Vector3d& p_W, double t_s) { close_cell(p_W, t_s + kOccupiedS); }
  /// Forgets what is older than that.
  void update(double t_s);

  /// Calls visit(p_W) with the middle of each cell; z is the height that was flown at then.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [cell, until_s] : until_s_) visit(middle_W(cell));
  }
  size_t size() const { return until_s_.size(); }

 private:
  using Cell = std::array<int, 3>;
  static constexpr size_t kMaxCells = 20'000;  ///< beyond, none is closed until some are forgotten

  void close_cell(const Eigen::Vector3d& p_W, double until_s);
  Eigen::Vector3d middle_W(const Cell& cell) const {
    return cell_m_ * (Eigen::Vector3d(cell[0], cell[1], cell[2]) + Eigen::Vector3d::Constant(0.5));
  }

  double cell_m_;
  std::map<Cell, double> until_s_;
};

/// The heights, in W's z, that the vehicle takes up: [top, bottom], m.
struct HeightRange {
  double top_m = 0.0, bottom_m = 0.0;
};

/// What is known of the plane of flight: a column of the map is occupied where any of its voxels within the band is,
/// free where all are, or where all its neighbors are and nothing was seen in it, and unknown otherwise; with distances
/// to both. Unknown columns that were closed at a height within the band are occupied.
class LevelSlice {
 public:
  using State = vision::mapping::OccupancyMap::State;

  void build(const vision::mapping::OccupancyMap& map, const HeightRange& band, const ClosedCells& closed);

  int side() const { return side_; }
  double cell_m() const { return cell_m_; }
  State at(int row, int col) const { return cells_[static_cast<size_t>(row * side_ + col)]; }
  bool contains(int row, int col) const { return row >= 0 && col >= 0 && row < side_ && col < side_; }
  Eigen::Vector2i cell(const Eigen::Vector2d& p_W) const {
    return ((p_W - corner_W_) / cell_m_).array().floor().cast<int>();
  }
  Eigen::Vector2d center(int row, int col) const { return corner_W_ + cell_m_ * Eigen::Vector2d(row + 0.5, col + 0.5); }

  /// Distance from the middle of a point's cell to the nearest occupied, or unknown, cell's edge, m: of the point
  /// itself it may be half a cell less.
  double to_occupied_m(const Eigen::Vector2d& p_W) const { return look_up(occupied_, p_W); }
  double to_unknown_m(const Eigen::Vector2d& p_W) const { return look_up(unknown_, p_W); }
  double to_occupied_m(int row, int col) const { return cell_m_ * (occupied_.at(row, col) - 0.5); }
  /// Distance from the point itself to the nearest occupied cell's edge, m: negative within one, more than `within_m`
  /// where it is farther, 0 out of the slice.
  double exactly_to_occupied_m(const Eigen::Vector2d& p_W, double within_m) const;

 private:
  double look_up(const vision::mapping::DistanceField& field, const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2i c = cell(p_W);
    return contains(c.x(), c.y()) ? cell_m_ * (field.at(c.x(), c.y()) - 0.5) : 0.0;
  }

  void fill_specks(const vision::mapping::OccupancyMap& map, int top, int bottom);
  void close(const ClosedCells& closed, const HeightRange& band);

  int side_ = 0;
  double cell_m_ = 1.0;
  Eigen::Vector2d corner_W_ = Eigen::Vector2d::Zero();
  std::vector<State> cells_, before_, row_;
  std::vector<uint8_t> marked_;
  vision::mapping::DistanceField occupied_, unknown_;
};

}  // namespace hedgehop::avoidance::local_map
