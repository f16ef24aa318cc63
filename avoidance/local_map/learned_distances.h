#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "avoidance/local_map/route_field.h"

namespace hedgehop::avoidance::local_map {

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
