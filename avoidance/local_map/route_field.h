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

/// Distance of a route from occupied cells: preferred and minimum distance, m.
struct RouteClearance {
  double preferred_m = 0.0, least_m = 0.0;
  enum class Detours { short_ones, usual, long_ones };
  Detours detours = Detours::usual;  ///< which are better than less than the preferred distance
};

/// Distance of every cell of the slice to the goal, through free and unknown space: [BrockKhatib1999] sec. on the
/// global dynamic window. Routes may pass unknown cells at a higher cost; only StopPlanner decides which path is flown.
/// Observations replace assumptions and are kept, so each visit excludes some of the possible routes.
class RouteField {
 public:
  /// @param beyond_m  distance to the goal from a point at the edge of the slice, m; used if the goal is outside.
  void build(const LevelSlice& slice, const RouteClearance& route_clearance, const Eigen::Vector2d& goal_W,
             const std::function<double(const Eigen::Vector2d&)>& beyond_m);

  /// Distance to the goal along the best route, m; unknown space counts kUnknownPrice times. Empty if there is no
  /// route.
  std::optional<double> to_goal_m(const Eigen::Vector2d& p_W) const;
  /// Points of the best route from a position, one cell apart.
  std::vector<Eigen::Vector2d> route_W(const Eigen::Vector2d& p_W, double length_m) const;
  /// Minimum distance of the best route to occupied cells within a length from a position, m.
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
  std::vector<uint8_t> price_;  ///< cost of a step, in tenths of a cell; 0 for blocked cells
  std::vector<std::vector<int>> buckets_;
  int waiting_ = 0;
  double beyond_m_ = 0.0;  ///< distance from the nearest edge to a goal outside
};

/// Distances to the goal that were found from positions in the map: lower bounds, which never decrease. Beyond the map
/// a straight line is assumed; if the map has covered a position and found no such path, the learned distance is used
/// instead. A dead end that is larger than the map, or than its memory, therefore becomes longer at each visit, until
/// the way around it is shorter. This prevents endless circling.
/// Source: [KoenigLikhachev2006] sec. on real-time adaptive A*. Differs: distances of the whole field are learned
/// instead of the states that a search expanded, and only at one position of each square.
class LearnedDistances {
 public:
  /// Stores the distances of the free positions around the vehicle. A new goal deletes all.
  /// @param p_W  position of the vehicle; its z is the altitude of the slice. @param goal_W  goal of the mission, which
  /// stays the same from call to call.
  void learn(const RouteField& route, const LevelSlice& slice, const Eigen::Vector3d& p_W,
             const Eigen::Vector3d& goal_W);

  /// Returns the distances to the goal beyond the map: straight lines or learned distances.
  std::function<double(const Eigen::Vector2d&)> beyond_m(const Eigen::Vector2d& goal_W, double z_W) const {
    return [this, goal_W, z_W](const Eigen::Vector2d& edge_W) {
      return std::max((goal_W - edge_W).norm(), at_least_m(edge_W, z_W));
    };
  }

  /// Returns the minimum distance to the goal from a position at an altitude, m; 0 if unknown. Distances from other
  /// altitudes count as well, minus the cost of climbing there and back, because most objects are vertical.
  double at_least_m(const Eigen::Vector2d& p_W, double z_W) const;

 private:
  using Square = std::pair<int, int>;  ///< north, east
  static Square square(const Eigen::Vector2d& p_W);

  std::map<Square, std::map<int, double>> distances_m_;  ///< by square and level
  std::optional<Eigen::Vector3d> goal_W_;
};

}  // namespace hedgehop::avoidance::local_map
