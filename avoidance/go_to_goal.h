#pragma once

#include <memory>
#include <string_view>

#include "avoidance/module.h"

namespace hedgehop::avoidance {

/// Flies straight to the goal and sees nothing: the control that every avoiding module is compared with.
struct GoToGoalConfig {
  static constexpr std::string_view kName = "go_to_goal";
  static constexpr std::string_view kMeaning = "fly straight to the goal without looking: the control experiment";

  double speed_mps = 2.0;
  double slow_radius_m = 4.0;
};

template <class Visitor>
void describe(Visitor& v, GoToGoalConfig& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed towards the goal"});
  v("slow_radius", c.slow_radius_m,
    {.unit = "m", .at_least = 0.0, .meaning = "distance to the goal within which the speed falls in proportion to it"});
}

/// Horizontal velocity towards a goal, constant outside `slow_radius_m` and falling linearly to zero inside it.
/// @param p_BG_W_xy  goal seen from B, north and east, m.
/// @return north and east, m/s.
Eigen::Vector2d velocity_to_goal(const Eigen::Vector2d& p_BG_W_xy, double speed_mps, double slow_radius_m);

/// Throws std::invalid_argument when the speed is not positive or the radius is negative.
std::unique_ptr<Module> make_go_to_goal(const GoToGoalConfig& config);

}  // namespace hedgehop::avoidance
