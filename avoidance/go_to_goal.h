#pragma once

#include <memory>
#include <string_view>

#include "avoidance/module.h"
#include "sim/fields/field.h"

namespace hedgehop::avoidance {

/// Flies straight to the goal without cameras. This is the control experiment for all avoidance modules.
struct GoToGoalConfig {
  static constexpr std::string_view kName = "go_to_goal";
  static constexpr std::string_view kMeaning = "flies straight to the goal without cameras: the control experiment";

  double speed_mps = 2.0;
  double slow_radius_m = 4.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GoToGoalConfig> auto& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed towards the goal"});
  v("slow_radius", c.slow_radius_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "distance to the goal within which the speed decreases in proportion to the distance"});
}

/// Returns the horizontal velocity towards a goal, north and east, m/s; zero at the goal itself.
/// @param p_BG_W_xy  position of the goal from B, north and east, m.  @param speed_mps  > 0.
/// @param slow_radius_m  distance within which the speed decreases linearly to zero, m; 0 disables this.
Eigen::Vector2d velocity_to_goal(const Eigen::Vector2d& p_BG_W_xy, double speed_mps, double slow_radius_m);

/// Throws std::invalid_argument on values out of range.
std::unique_ptr<Module> make_go_to_goal(const GoToGoalConfig& config);

}  // namespace hedgehop::avoidance
