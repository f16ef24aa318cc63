#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "avoidance/local_map/route_field.h"
#include "avoidance/local_map/surroundings.h"

namespace hedgehop::avoidance::local_map {

/// Heights to fly at: levels a step apart within the mission's altitude band, one of them that of the flight's start.
/// The vehicle climbs or sinks towards the level in the map from which the way to the goal, and the climbing, is
/// shortest. Ours: after the plane's own rule (route_field.h). A search in three dimensions would see over two edges at
/// once.
class AltitudeLevels {
 public:
  AltitudeLevels() = default;
  /// @param band  none: only the start's level.
  AltitudeLevels(const std::optional<AltitudeBand>& band, const RouteClearance& route_clearance)
      : band_(band), route_clearance_(route_clearance) {}
  /// @param first_W  z of the start.
  void begin(double first_W);

  /// Whether all that lies between two levels is seen to be free where the vehicle will be.
  using MayPass = std::function<bool(const LevelSlice&)>;
  /// The level beside the one that is flown at, z in W, that is to be flown at instead; nothing where this one is as
  /// good, on the way to one, and for a second after it was asked. @param t_s  rises from call to call.
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
