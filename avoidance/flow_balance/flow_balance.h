#pragma once

#include <memory>
#include <numbers>
#include <string_view>

#include "avoidance/module.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::flow_balance {

/// Keeps away from walls by balancing optic flow and loom of cameras that look forward, aft, left and right.
/// Source: [Garratt2009] sec. 4 (`simple`) and sec. 4.1, eq. (4) (`goal_directed`).
struct FlowBalanceConfig {
  static constexpr std::string_view kName = "flow_balance";
  static constexpr std::string_view kMeaning = "four cameras' optic flow and loom push the vehicle away from walls";

  enum class Scheme { simple, goal_directed };
  /// `all` suits open country and sky: what has no texture is taken as infinitely far, so a wall counts by the share of
  /// the view it fills. `valid` suits rooms, where a patch without texture is a bare wall; with walls in a part of the
  /// view only, its mean flow is that of off-center patches, in which motion along the axis shows too.
  enum class Average { valid, all };
  enum class Ranging { mean, nearest };

  Scheme scheme = Scheme::goal_directed;
  vision::flow::ImageInterpolationConfig flow;
  bool derotate = false;
  Average average = Average::all;
  Ranging ranging = Ranging::mean;
  double near_share = 0.1;
  int near_images = 3;
  double range_memory_s = 0.0;
  double wall_error = 0.0;
  double flow_noise_px = 0.1;
  double tail_m = 0.0;
  double divisor_floor_mps = 0.2;

  double speed_mps = 2.0;
  double slow_radius_m = 4.0;
  double loom_gain_m2ps = 4.0;  ///< k0
  double flow_gain_m2ps = 5.0;  ///< k1
  double spiral_angle_rad = 0.0;
  double patience_s = 0.0;
  double detour_angle_rad = 70.0 * std::numbers::pi / 180.0;
  double detour_duration_s = 12.0;
  double command_time_constant_s = 0.0;

  double forward_speed_mps = 1.0;
  double sideways_speed_mps = 1.0;
  double range_threshold_m = 2.0;
  double braking_mps2 = 1.0;
  double reaction_s = 0.0;
  double stray_rad = 0.0;
  double way_angle_rad = std::numbers::pi / 3;
  int confirmations = 2;
};

template <class Visitor>
void describe(Visitor& v, FlowBalanceConfig& c) {
  v("scheme", c.scheme,
    {.choices = {"simple", "goal_directed"},
     .meaning = "simple: zig-zag, turning round before walls; goal_directed: seek the goal, pushed away from walls"});
  v("flow", c.flow, {.meaning = "the grid of patches on each camera and the flow algorithm"});
  v("derotate", c.derotate, {.meaning = "take the flow of the vehicle's own rotation, known from the gyros, away"});
  v("average", c.average,
    {.choices = {"valid", "all"},
     .meaning = "mean flow and loom over valid patches, or over all with invalid ones (sky) as infinitely far"});
  v("ranging", c.ranging,
    {.choices = {"mean", "nearest"},
     .meaning =
         "nearness of walls from a camera's mean flow and loom (the paper), or from its nearest patches, each by "
         "its own flow (ours; wants derotate)"});
  v("near_share", c.near_share,
    {.above = 0.0, .at_most = 1.0, .meaning = "ranging nearest: share of a camera's patches taken as the nearest"});
  v("near_images", c.near_images,
    {.at_least = 1,
     .at_most = 20,
     .meaning = "ranging nearest: a patch is as near as the last images, this many, agree on"});
  v("range_memory", c.range_memory_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "ranging nearest: a patch of which the flow tells nothing stays as it was, fading with this time "
                "constant; 0 forgets at once"});
  v("wall_error", c.wall_error,
    {.at_least = 0.0,
     .meaning = "simple, ranging nearest: upright walls that the flow of all cameras fits with a relative error of "
                "at most this are ranged in place of the patches; 0 looks for none"});
  v("flow_noise", c.flow_noise_px,
    {.unit = "px",
     .above = 0.0,
     .meaning = "simple, walls of wall_error: standard deviation of a flow vector, per axis"});
  v("tail", c.tail_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "simple, walls of wall_error: the vehicle reaches so much farther aft than to its other sides"});
  v("divisor_floor", c.divisor_floor_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "velocities that flow and loom are divided by are at least this large"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "goal_directed: speed flown"});
  v("slow_radius", c.slow_radius_m,
    {.unit = "m", .at_least = 0.0, .meaning = "goal_directed: distance to the goal within which the speed falls"});
  v("loom_gain", c.loom_gain_m2ps, {.unit = "m^2/s", .at_least = 0.0, .meaning = "goal_directed: k0"});
  v("flow_gain", c.flow_gain_m2ps, {.unit = "m^2/s", .at_least = 0.0, .meaning = "goal_directed: k1"});
  v("spiral_angle", c.spiral_angle_rad,
    {.unit = "deg",
     .at_least = -60.0,
     .at_most = 60.0,
     .meaning = "goal_directed: aim this far right of the goal, to leave limit cycles"});
  v("patience", c.patience_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "goal_directed: when the goal comes no nearer for so long, aim aside for a while; 0 never does"});
  v("detour_angle", c.detour_angle_rad,
    {.unit = "deg", .above = 0.0, .at_most = 180.0, .meaning = "goal_directed: how far aside, right and left in turn"});
  v("detour_duration", c.detour_duration_s,
    {.unit = "s", .above = 0.0, .meaning = "goal_directed: how long the aim stays aside"});
  v("command_time_constant", c.command_time_constant_s,
    {.unit = "s", .at_least = 0.0, .meaning = "goal_directed: low-pass filter of the commanded velocity; 0 for none"});
  v("forward_speed", c.forward_speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "simple: speed along the heading"});
  v("sideways_speed", c.sideways_speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "simple: speed across it"});
  v("range_threshold", c.range_threshold_m,
    {.unit = "m", .above = 0.0, .meaning = "simple: turn round when flow or loom tell a shorter range"});
  v("braking", c.braking_mps2,
    {.unit = "m/s^2",
     .above = 0.0,
     .meaning = "simple, ranging nearest: deceleration counted on; the distance it takes to stop is kept in hand"});
  v("reaction", c.reaction_s,
    {.unit = "s", .at_least = 0.0, .meaning = "simple: time that passes before the vehicle slows down by braking"});
  v("stray", c.stray_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 30.0,
     .meaning = "simple: every turn bends the way off its diagonal by a random angle up to this; 0 for the paper's"});
  v("way_angle", c.way_angle_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 90.0,
     .meaning = "simple, ranging nearest: a wall counts that is seen within this angle of the way flown"});
  v("confirmations", c.confirmations,
    {.at_least = 1, .meaning = "simple: successive images that must agree before turning round"});
}

/// Throws std::invalid_argument on values out of range.
std::unique_ptr<Module> make_flow_balance(const FlowBalanceConfig& config);

}  // namespace hedgehop::avoidance::flow_balance
