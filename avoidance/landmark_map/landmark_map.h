#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "avoidance/landmark_map/landmark_sight.h"
#include "avoidance/module.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::landmark_map {

/// A circle flown about an object that the nose keeps pointing at: the lateral flight of [Shah2009] ch. 4.
struct Orbit {
  double north_m = 0.0, east_m = 0.0;
  double rate_radps = 6.283185307179587e-3;  ///< 0.36 deg/s, [Shah2009] table 4.1
};
template <class Visitor>
void describe(Visitor& v, Orbit& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "of the object in the middle"});
  v("east", c.east_m, {.unit = "m", .meaning = "of the object in the middle"});
  v("rate", c.rate_radps, {.unit = "deg/s", .meaning = "round it, clockwise seen from above"});
}

/// Maps the corners that one camera sees and flies round what they belong to; stops before walls without corners.
/// Source: [Shah2009] ch. 4 for the map. Avoiding and stopping are ours: the thesis leaves them to others, ch. 7.
struct LandmarkMapModuleConfig {
  static constexpr std::string_view kName = "landmark_map";
  static constexpr std::string_view kMeaning = "maps the corners that one camera sees and flies round them";

  LandmarkSightConfig sight;
  double speed_mps = 2.0;
  std::optional<Orbit> orbit;

  double clearance_m = 6.0;
  double link_m = 14.0;
  double behind_m = 8.0;
  double lowest_m = 4.0;
  double most_sigma_m = 2.0;

  vision::flow::ImageInterpolationConfig flow;
  double time_to_contact_s = 5.0;
  double flow_share = 0.5;
  double loom_time_s = 0.8;
  double stop_range_m = 5.0;
  double braking_mps2 = 0.5;
};

template <class Visitor>
void describe(Visitor& v, LandmarkMapModuleConfig& c) {
  describe(v, c.sight);
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "along the course and round obstacles"});
  v("orbit", c.orbit, {.meaning = "a circle to fly, nose to its middle, instead of a course to the goal"});
  v("clearance", c.clearance_m,
    {.unit = "m", .above = 0.0, .meaning = "kept between the vehicle's hull and the obstacles of the map"});
  v("link", c.link_m,
    {.unit = "m", .at_least = 0.0, .meaning = "landmarks within this of one another bound one obstacle"});
  v("behind", c.behind_m,
    {.unit = "m", .at_least = 0.0, .meaning = "obstacles reach so far behind the corners seen of them"});
  v("lowest", c.lowest_m, {.unit = "m", .meaning = "landmarks below this height are no obstacles"});
  v("most_sigma", c.most_sigma_m,
    {.unit = "m", .above = 0.0, .meaning = "landmarks of a larger standard deviation are no obstacles yet"});
  v("flow", c.flow, {.meaning = "the optic flow whose divergence tells of a wall"});
  v("time_to_contact", c.time_to_contact_s,
    {.unit = "s", .at_least = 0.0, .meaning = "flow divergence of a nearer contact stops the flight; 0 never"});
  v("flow_share", c.flow_share,
    {.above = 0.0, .at_most = 1.0, .meaning = "share of the image that must flow for its divergence to count"});
  v("loom_time", c.loom_time_s,
    {.unit = "s", .at_least = 0.0, .meaning = "over which the flow's divergence is smoothed: one pair of images errs"});
  v("stop_range", c.stop_range_m,
    {.unit = "m", .at_least = 0.0, .meaning = "left to what the range finder meets once the flight has stopped"});
  v("braking", c.braking_mps2, {.unit = "m/s^2", .above = 0.0, .meaning = "deceleration counted on before a range"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_landmark_map(const LandmarkMapModuleConfig& config);

}  // namespace hedgehop::avoidance::landmark_map
