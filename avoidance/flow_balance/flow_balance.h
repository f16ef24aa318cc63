#pragma once

#include <memory>
#include <numbers>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::flow_balance {

/// Flies to a goal and keeps away from walls, with the optic flow of cameras that look forward, aft, left and right.
/// Source: [Garratt2009] sec. 4.1, eq. (4): balance_law.h. The additions of the modified law: PatchRanging,
/// modified_balance.h, approach_limit.h.
struct FlowBalanceConfig {
  static constexpr std::string_view kName = "flow_balance";
  static constexpr std::string_view kMeaning =
      "flies to a goal while the optic flow and loom of four cameras push the vehicle away from walls";

  Law law = Law::modified;
  vision::flow::ImageInterpolationConfig flow;
  double speed_mps = 2.0;
  double loom_gain_m2ps = 4.0;  ///< k0
  double flow_gain_m2ps = 5.0;  ///< k1
  double spiral_angle_rad = 0.0;
  double slow_radius_m = 4.0;
  double patience_s = 0.0;
  double command_time_constant_s = 0.0;
  double max_elevation_rad = std::numbers::pi / 2;
  double memory_s = 4.0;
  double release_s = 0.0;
  double clearance_m = 0.0;
  double braking_mps2 = 0.4;
  double reaction_s = 1.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FlowBalanceConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "published: [Garratt2009] eq. (4) with the mean flow and loom of each camera; modified: derotated "
                "flow, and ranges of the nearest patches of each camera instead of both"});
  v("flow", c.flow, {.meaning = "grid of patches on each camera and flow algorithm"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "flight speed"});
  v("loom_gain", c.loom_gain_m2ps,
    {.unit = "m^2/s", .at_least = 0.0, .meaning = "gain k0 on loom; the modified law uses k0 + k1"});
  v("flow_gain", c.flow_gain_m2ps,
    {.unit = "m^2/s", .at_least = 0.0, .meaning = "gain k1 on flow; the modified law uses k0 + k1"});
  v("spiral_angle", c.spiral_angle_rad,
    {.unit = "deg",
     .at_least = -60.0,
     .at_most = 60.0,
     .meaning = "angle of the aim to the right of the goal, to leave limit cycles"});
  v("slow_radius", c.slow_radius_m,
    {.unit = "m", .at_least = 0.0, .meaning = "modified law: distance to the goal within which the speed decreases"});
  v("patience", c.patience_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning =
         "modified law: time without progress to the goal after which the aim turns aside by 70 deg for 12 s, and "
         "for up to 96 s if that does not help; 0 disables this"});
  v("command_time_constant", c.command_time_constant_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "modified law: time constant of the low-pass filter of the commanded velocity; 0 disables the filter"});
  v("max_elevation", c.max_elevation_rad,
    {.unit = "deg",
     .at_least = -60.0,
     .at_most = 90.0,
     .meaning =
         "modified law: only patches centered below this elevation over the horizon measure obstacles; use a negative "
         "value when flying below the tops of buildings, because a smooth sky yields false flow while the vehicle "
         "tilts; 90: all patches count"});
  v("memory", c.memory_s,
    {.unit = "s",
     .above = 0.0,
     .meaning = "modified law: time for which an obstacle is remembered in a direction without sufficient flow"});
  v("release", c.release_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "modified law: time constant with which a remembered obstacle recedes if its direction is measured to "
                "be free or farther; 0: at once"});
  v("clearance", c.clearance_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "modified law: distance between the vehicle's cylinder and an obstacle at which the approach ends; 0: "
                "the speed is not limited"});
  v("braking", c.braking_mps2,
    {.unit = "m/s^2", .above = 0.0, .meaning = "modified law: deceleration before an obstacle"});
  v("reaction", c.reaction_s,
    {.unit = "s", .at_least = 0.0, .meaning = "modified law: time before the vehicle decelerates"});
}

/// Throws std::invalid_argument if a value is out of range.
std::unique_ptr<Module> make_flow_balance(const FlowBalanceConfig& config);

}  // namespace hedgehop::avoidance::flow_balance
