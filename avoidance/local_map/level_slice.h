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

/// Cells of the plane of flight that count as obstacles while the map does not know them: cells that stayed unknown
/// despite long observation, such as a plain wall, and cells that were observed as occupied and have since left the map
/// or its memory. Cells that are observed as free count as free. As a result, the search continues elsewhere and ends.
/// Not from a paper: without it, a planner that assumes unknown space to be free waits in front of a plain wall without
/// end, and tries a wall that is longer than its map again and again.
class ClosedCells {
 public:
  static constexpr double kUnknownS = 90.0, kOccupiedS = 600.0;  ///< lifetime of unknown and of occupied cells

  /// @param cell_m  edge length of the cells of the slice, > 0.
  explicit ClosedCells(double cell_m) : cell_m_(cell_m) {}

  /// Closes a disc at an altitude. @param t_s  current time, increasing.
  void close(const Eigen::Vector3d& p_W, double radius_m, double t_s);
  /// Closes one cell that was observed as occupied.
  void remember(const Eigen::Vector3d& p_W, double t_s) { close_cell(p_W, t_s + kOccupiedS); }
  /// Deletes cells at the end of their lifetime.
  void update(double t_s);

  /// Calls visit(p_W) with the center of each cell; z is within half a cell of that at which it was closed.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [cell, until_s] : until_s_) visit(middle_W(cell));
  }
  size_t size() const { return until_s_.size(); }

 private:
  using Cell = std::array<int, 3>;
  static constexpr size_t kMaxCells = 20'000;  ///< maximum number of cells; further cells are not closed

  void close_cell(const Eigen::Vector3d& p_W, double until_s);
  Eigen::Vector3d middle_W(const Cell& cell) const {
    return cell_m_ * (Eigen::Vector3d(cell[0], cell[1], cell[2]) + Eigen::Vector3d::Constant(0.5));
  }

  double cell_m_;
  std::map<Cell, double> until_s_;
};

/// Altitudes that the vehicle occupies, as z of W: [top, bottom], m.
struct HeightRange {
  double top_m = 0.0, bottom_m = 0.0;
};

/// The plane of flight. A column of the map is occupied if any of its voxels within the altitude range is occupied. It
/// is free if all of them are free, or if all its neighbors are free and no surface was observed in it. Otherwise it is
/// unknown. The slice has distances to occupied and to unknown cells. Unknown columns that were closed at an altitude
/// within the range are occupied.
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

  /// Distance from the center of the cell of a point to the edge of the nearest occupied, or unknown, cell, m. From the
  /// point itself it may be half a cell less.
  double to_occupied_m(const Eigen::Vector2d& p_W) const { return look_up(occupied_, p_W); }
  double to_unknown_m(const Eigen::Vector2d& p_W) const { return look_up(unknown_, p_W); }
  double to_occupied_m(int row, int col) const { return cell_m_ * (occupied_.at(row, col) - 0.5); }
  /// Distance from the point itself to the edge of the nearest occupied cell, m: negative inside one, a value above
  /// `within_m` if it is farther, 0 outside the slice.
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
