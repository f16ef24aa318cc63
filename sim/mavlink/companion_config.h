#pragma once

#include "sim/fields/field.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::sim::mavlink {

/// Messages about the surroundings and the vehicle's motion, for an autopilot.
struct PerceptionConfig {
  bool obstacle_distance = true, distance_sensor = true, optical_flow = true, vision_position = true, odometry = true;
  double min_m = 0.3, max_m = 20.0;
  double band_m = 0.5;
  vision::stereo::StereoMatcherConfig stereo{.method = vision::stereo::StereoMatcherConfig::Method::block,
                                             .block_px = 11};  ///< of images up to 640 px wide
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PerceptionConfig> auto& c) {
  v("obstacle_distance", c.obstacle_distance,
    {.meaning = "OBSTACLE_DISTANCE: 72 sectors from the depth or stereo images of the module"});
  v("distance_sensor", c.distance_sensor, {.meaning = "DISTANCE_SENSOR: height above ground"});
  v("optical_flow", c.optical_flow,
    {.meaning = "OPTICAL_FLOW (ArduPilot) or OPTICAL_FLOW_RAD (PX4) from the images of the module's camera that looks "
                "down"});
  v("vision_position", c.vision_position, {.meaning = "VISION_POSITION_ESTIMATE: estimated position and attitude"});
  v("odometry", c.odometry, {.meaning = "ODOMETRY: estimated position, attitude and velocities"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.01, .at_most = 100.0, .meaning = "minimum range of a sector"});
  v("max", c.max_m, {.unit = "m", .at_least = 0.02, .at_most = 600.0, .meaning = "maximum range of a sector"});
  v("band", c.band_m,
    {.unit = "m",
     .above = 0.0,
     .at_most = 100.0,
     .meaning = "height above and below the hull in which obstacles count for the sectors"});
  v("stereo", c.stereo, {.meaning = "stereo matching for the sectors"});
}

/// Messages to an autopilot.
struct CompanionConfig {
  bool steer = true;
  PerceptionConfig perception;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CompanionConfig> auto& c) {
  v("steer", c.steer,
    {.meaning = "whether the module steers the autopilot: mode GUIDED or OFFBOARD, arming, take-off and setpoints; if "
                "false, a ground station or the autopilot's own mission does"});
  v("perception", c.perception, {.meaning = "messages from the module's images and the navigation estimate"});
}

}  // namespace hedgehop::sim::mavlink
