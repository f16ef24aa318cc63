#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>

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
  static constexpr size_t kMost = 20'000;  ///< beyond, none is closed until some are forgotten

  void close_cell(const Eigen::Vector3d& p_W, double until_s);
  Eigen::Vector3d middle_W(const Cell& cell) const {
    return cell_m_ * (Eigen::Vector3d(cell[0], cell[1], cell[2]) + Eigen::Vector3d::Constant(0.5));
  }

  double cell_m_;
  std::map<Cell, double> until_s_;
};

}  // namespace hedgehop::avoidance::local_map
