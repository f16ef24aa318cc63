#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::flow_balance {

/// Explores a room: flies along diagonals and reverses in front of walls. It has no goal except an altitude and a
/// heading. Source: [Garratt2009] sec. 4: zig_zag_law.h. The additions of the modified law: PatchRanging, WallRanging,
/// ConfirmedZigZag, turn_clearance.h, VisitedFloor.
struct ZigZagConfig {
  static constexpr std::string_view kName = "zig_zag";
  static constexpr std::string_view kMeaning =
      "explores a room along diagonals and reverses in front of walls, by optic flow";

  Law law = Law::modified;
  vision::flow::ImageInterpolationConfig flow{.rows = 1, .cols = 8};
  double forward_speed_mps = 1.0;
  double sideways_speed_mps = 1.0;
  double range_threshold_m = 2.0;
  double braking_mps2 = 1.0;
  double reaction_s = 0.0;
  double tail_m = 0.0;
  double stray_rad = 0.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ZigZagConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning =
         "published: ranges from the mean flow and loom of each camera, [Garratt2009] sec. 4; modified: "
         "derotated flow, ranges of fitted walls, stopping distance, confirmed reversals, turns away from both walls "
         "of a corner, memory of the visited floor"});
  v("flow", c.flow, {.meaning = "grid of patches on each camera and flow algorithm"});
  v("forward_speed", c.forward_speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed along the heading"});
  v("sideways_speed", c.sideways_speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed across the heading"});
  v("range_threshold", c.range_threshold_m,
    {.unit = "m", .above = 0.0, .meaning = "range from flow or loom below which the vehicle reverses"});
  v("braking", c.braking_mps2,
    {.unit = "m/s^2",
     .above = 0.0,
     .meaning = "modified law: deceleration of the vehicle; its stopping distance is added to the threshold"});
  v("reaction", c.reaction_s,
    {.unit = "s", .at_least = 0.0, .meaning = "modified law: time before the vehicle decelerates"});
  v("tail", c.tail_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "modified law: additional extent of the vehicle aft, compared with its other sides"});
  v("stray", c.stray_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 30.0,
     .meaning =
         "modified law: maximum rotation of the path from its diagonal; each reversal compares random angles and "
         "takes the one with the maximum of unvisited floor"});
}

/// Throws std::invalid_argument if a value is out of range.
std::unique_ptr<Module> make_zig_zag(const ZigZagConfig& config);

}  // namespace hedgehop::avoidance::flow_balance
