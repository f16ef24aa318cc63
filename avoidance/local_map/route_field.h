#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "avoidance/local_map/level_slice.h"

namespace hedgehop::avoidance::local_map {

/// How far a route stays from what is occupied: as far as wanted where it can, and nowhere nearer than the least, m.
struct Berth {
  double wanted_m = 0.0, least_m = 0.0;
};

/// How far every cell of the slice is from the goal, through what is free or may be: [BrockKhatib1999] sec. on the
/// global dynamic window. Unknown cells may be passed on paper, at a price; only StopPlanner decides what
/// may be flown. Because what is seen replaces what was assumed, and stays, each visit rules something out.
class RouteField {
 public:
  /// @param beyond_m  distance to the goal from a point at the slice's edge, m; used where the goal lies outside.
  void build(const LevelSlice& slice, const Berth& berth, const Eigen::Vector2d& goal_W,
             const std::function<double(const Eigen::Vector2d&)>& beyond_m);

  /// Distance to the goal along the best route, m, unknown space counted kUnknownPrice times; nothing where there is
  /// none.
  std::optional<double> to_goal_m(const Eigen::Vector2d& p_W) const;
  /// Points of the best route from here, a cell apart.
  std::vector<Eigen::Vector2d> route_W(const Eigen::Vector2d& p_W, double length_m) const;
  /// How near the best route comes to what is occupied within a length from here, m.
  double nearest_m(const Eigen::Vector2d& p_W, double length_m) const;

  static constexpr double kUnknownPrice = 1.5;

 private:
  static constexpr int kNever = 1 << 29;
  int cost(int row, int col) const { return cost_[static_cast<size_t>(row * slice_->side() + col)]; }
  bool cuts_corner(int row, int col, int rows, int cols) const;
  std::optional<double> back_to_route_m(const Eigen::Vector2d& p_W) const;
  void seed(const Eigen::Vector2d& goal_W, const std::function<double(const Eigen::Vector2d&)>& beyond_m);
  void push(int cell, int cost);
  void spread();

  const LevelSlice* slice_ = nullptr;
  std::vector<int> cost_;
  std::vector<uint8_t> price_;  ///< of a step, in tenths of a cell; 0 may not be entered
  std::vector<std::vector<int>> buckets_;
  int waiting_ = 0;
  double beyond_m_ = 0.0;  ///< from the nearest edge to a goal outside
};

}  // namespace hedgehop::avoidance::local_map
