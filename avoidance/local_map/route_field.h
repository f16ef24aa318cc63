#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "avoidance/local_map/level_slice.h"

namespace hedgehop::avoidance::local_map {

/// How far a route stays from what is occupied: as far as wanted where it can, and nowhere nearer than the least, m.
struct RouteClearance {
  double preferred_m = 0.0, least_m = 0.0;
};

/// How far every cell of the slice is from the goal, through what is free or may be: [BrockKhatib1999] sec. on the
/// global dynamic window. Unknown cells may be passed on paper, at a price; only StopPlanner decides what
/// may be flown. Because what is seen replaces what was assumed, and stays, each visit rules something out.
class RouteField {
 public:
  /// @param beyond_m  distance to the goal from a point at the slice's edge, m; used where the goal lies outside.
  void build(const LevelSlice& slice, const RouteClearance& route_clearance, const Eigen::Vector2d& goal_W,
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

/// How far the goal was found to be from places in the map: a lower bound, which never falls. Beyond the map a straight
/// line is hoped for; where the map has been and found no such way, what it found counts instead. So a dead end that is
/// larger than the map, or than its memory, looks longer at each visit, until the way round it is shorter: nothing is
/// circled in for ever.
/// Source: [KoenigLikhachev2006] sec. on real-time adaptive A*. Differs: distances of the whole field are learned, not
/// of the states that a search expanded, and only of one place in each square.
class LearnedDistances {
 public:
  /// Takes what the field says of the free places around the vehicle. Another goal forgets all.
  /// @param p_W  of the vehicle; its z is the height of the slice. @param goal_W  as the mission names it, so that it
  /// stays the same from call to call.
  void learn(const RouteField& route, const LevelSlice& slice, const Eigen::Vector3d& p_W,
             const Eigen::Vector3d& goal_W);

  /// Distances to the goal beyond the map: straight, or what was learned.
  std::function<double(const Eigen::Vector2d&)> beyond_m(const Eigen::Vector2d& goal_W, double z_W) const {
    return [this, goal_W, z_W](const Eigen::Vector2d& edge_W) {
      return std::max((goal_W - edge_W).norm(), at_least_m(edge_W, z_W));
    };
  }

  /// Distance to the goal from a place at a height, m, at least; 0 where nothing was learned. What was learned at other
  /// heights counts too, less what it takes to climb there and back: most things stand upright.
  double at_least_m(const Eigen::Vector2d& p_W, double z_W) const;

 private:
  using Square = std::pair<int, int>;  ///< north, east
  static Square square(const Eigen::Vector2d& p_W);

  std::map<Square, std::map<int, double>> distances_m_;  ///< by square and level
  std::optional<Eigen::Vector3d> goal_W_;
};

}  // namespace hedgehop::avoidance::local_map
