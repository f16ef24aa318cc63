#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "avoidance/local_map/route_field.h"
#include "avoidance/local_map/surroundings.h"

namespace hedgehop::avoidance::local_map {

/// Flight altitudes: levels with a constant spacing within the altitude band of the mission; one level is the altitude
/// of the start. The vehicle climbs or descends to the level in the map with the shortest way to the goal, including
/// the change of altitude. Not from a paper; analogous to the rule in the plane (route_field.h). In contrast to a
/// search in three dimensions, it does not plan over two edges at once.
class AltitudeLevels {
 public:
  AltitudeLevels() = default;
  /// @param band  empty: only the level of the start.
  AltitudeLevels(const std::optional<AltitudeBand>& band, const RouteClearance& route_clearance)
      : band_(band), route_clearance_(route_clearance) {}
  /// @param first_W  z of the start.
  void begin(double first_W);

  /// Returns whether all space between two levels is observed as free at the positions of the vehicle.
  using MayPass = std::function<bool(const LevelSlice&)>;
  /// Returns the adjacent level to change to, z in W. Empty if the current level is as good, during a change of level,
  /// and for one second after each evaluation. @param t_s  increases from call to call.
  std::optional<double> next_W(double t_s, const Surroundings& around, const LearnedDistances& learned,
                               const Eigen::Vector2d& p_W, const Eigen::Vector3d& goal_W, const MayPass& may_pass);

 private:
  double z_W(int level) const { return first_W_ - kStepM * level; }
  double way_m(const Surroundings& around, const LearnedDistances& learned, int level, const Eigen::Vector2d& p_W,
               const Eigen::Vector3d& goal_W);

  static constexpr double kStepM = 1.2;
  std::optional<AltitudeBand> band_;
  RouteClearance route_clearance_;
  double first_W_ = 0.0, checked_s_ = 0.0;
  int lowest_ = 0, highest_ = 0, level_ = 0, last_side_ = 0;
  LevelSlice slice_;
  RouteField route_;
};

}  // namespace hedgehop::avoidance::local_map
