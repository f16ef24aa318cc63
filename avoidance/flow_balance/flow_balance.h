#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::flow_balance {

/// Seeks a goal and keeps away from walls by the optic flow of cameras that look forward, aft, left and right.
/// Source: [Garratt2009] sec. 4.1, eq. (4), as printed or with our additions (PatchRanging, range_balance.h, Detour).
struct FlowBalanceConfig {
  static constexpr std::string_view kName = "flow_balance";
  static constexpr std::string_view kMeaning =
      "seeks a goal while four cameras' optic flow and loom push the vehicle away from walls";

  Law law = Law::modified;
  vision::flow::ImageInterpolationConfig flow;
  double speed_mps = 2.0;
  double loom_gain_m2ps = 4.0;  ///< k0
  double flow_gain_m2ps = 5.0;  ///< k1
  double spiral_angle_rad = 0.0;
  double slow_radius_m = 4.0;
  double patience_s = 0.0;
  double command_time_constant_s = 0.0;
};

template <class Visitor>
void describe(Visitor& v, FlowBalanceConfig& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning =
         "published: [Garratt2009] eq. (4) by each camera's mean flow and loom; modified: derotated flow, and ranges "
         "of each camera's nearest patches in place of both"});
  v("flow", c.flow, {.meaning = "the grid of patches on each camera and the flow algorithm"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed flown"});
  v("loom_gain", c.loom_gain_m2ps, {.unit = "m^2/s", .at_least = 0.0, .meaning = "k0; law modified uses k0 + k1"});
  v("flow_gain", c.flow_gain_m2ps, {.unit = "m^2/s", .at_least = 0.0, .meaning = "k1; law modified uses k0 + k1"});
  v("spiral_angle", c.spiral_angle_rad,
    {.unit = "deg",
     .at_least = -60.0,
     .at_most = 60.0,
     .meaning = "aim this far right of the goal, to leave limit cycles"});
  v("slow_radius", c.slow_radius_m,
    {.unit = "m", .at_least = 0.0, .meaning = "law modified: distance to the goal within which the speed falls"});
  v("patience", c.patience_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "law modified: after so long without progress to the goal, aim 70 deg aside for 12 s; 0 never does"});
  v("command_time_constant", c.command_time_constant_s,
    {.unit = "s", .at_least = 0.0, .meaning = "law modified: low-pass filter of the commanded velocity; 0 for none"});
}

/// Throws std::invalid_argument on values out of range.
std::unique_ptr<Module> make_flow_balance(const FlowBalanceConfig& config);

}  // namespace hedgehop::avoidance::flow_balance
