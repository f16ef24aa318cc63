#pragma once

#include <Eigen/Core>
#include <set>
#include <utility>

namespace hedgehop::avoidance::flow_balance {

/// Remembers which squares of the floor a vehicle has flown over, so that an exploration does not repeat one path. A
/// square counts if the vehicle has covered its center. Positions are estimates and drift without satellites, so the
/// squares are as coarse as the vehicle. Not in the paper: the scheme of [Garratt2009] sec. 4 has no memory.
class VisitedFloor {
 public:
  /// @param cell_m  side of a square, > 0. @param reach_m  radius of the covered disc, > 0.
  explicit VisitedFloor(double cell_m = 1.0, double reach_m = 0.7) : cell_m_(cell_m), reach_m_(reach_m) {}

  /// Marks the squares that the vehicle covers. @param p_NE  its position, north and east, m.
  void visit(const Eigen::Vector2d& p_NE);
  /// Returns the number of unvisited squares that a straight flight covers.
  /// @param from_NE  start of the path, m. @param direction_NE  length 1. @param length_m  >= 0.
  int unvisited(const Eigen::Vector2d& from_NE, const Eigen::Vector2d& direction_NE, double length_m) const;

 private:
  using Squares = std::set<std::pair<int, int>>;
  void cover(const Eigen::Vector2d& p_NE, Squares& squares) const;

  double cell_m_, reach_m_;
  Squares visited_;
};

}  // namespace hedgehop::avoidance::flow_balance
