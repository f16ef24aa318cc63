#pragma once

#include <memory>
#include <numbers>
#include <string_view>

#include "avoidance/corridor_centering/centering_law.h"
#include "avoidance/law.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"

namespace hedgehop::avoidance::corridor_centering {

/// Flies along the middle of a corridor, with the flow of the walls in a fisheye image. Source: [Zingg2010] sec. IV,
/// and sec. V-C: centering_law.h. The modified law: pursuit.h.
struct CorridorCenteringConfig {
  static constexpr std::string_view kName = "corridor_centering";
  static constexpr std::string_view kMeaning =
      "flies along the middle of a corridor with the flow of the walls in a fisheye image";

  Law law = Law::modified;
  double attitude_lag_s = 0.0032;  ///< of a first-order filter of 50 Hz on the gyros
  double probe_s = 3.0;

  CenteringGains gains;
  double sample_s = 0.5;                              ///< [Zingg2010] sec. V-C
  double pitch_rad = 0.5 * std::numbers::pi / 180.0;  ///< nose down; [Zingg2010] sec. V-C

  double speed_mps = 0.8;
  double braking_mps2 = 1.0;
  double lookahead_m = 1.5;
  double margin_m = 0.15;
  double probe_mps = 0.3;
  double yaw_rate_radps = 0.5235987755982988;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CorridorCenteringConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning =
         "published: roll and turn rate from the paper's controller at constant pitch; modified: fly towards the "
         "middle of the gap ahead, measured across the direction of the walls, and turn away from obstacles ahead"});
  v("attitude_lag", c.attitude_lag_s,
    {.unit = "s", .at_least = 0.0, .at_most = 0.1, .meaning = "lag of the gyro-based attitude estimate"});
  v("probe_time", c.probe_s,
    {.unit = "s", .above = 0.0, .meaning = "maximum flight time without a measurement of the walls"});
  v("gains", c.gains, {.meaning = "published: gains of the controller"});
  v("sample", c.sample_s, {.unit = "s", .above = 0.0, .meaning = "published: sampling time of the controller"});
  v("pitch", c.pitch_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 20.0, .meaning = "published: constant pitch, nose down"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "modified: speed without near obstacles"});
  v("braking", c.braking_mps2, {.unit = "m/s^2", .above = 0.0, .meaning = "modified: assumed deceleration"});
  v("lookahead", c.lookahead_m, {.unit = "m", .above = 0.0, .meaning = "modified: distance of the target point"});
  v("margin", c.margin_m, {.unit = "m", .at_least = 0.0, .meaning = "modified: minimum clearance of the hull"});
  v("probe_speed", c.probe_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "modified: minimum speed, also without measurements"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "modified: turn rate if the path ahead is blocked"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_corridor_centering(const CorridorCenteringConfig& config);

}  // namespace hedgehop::avoidance::corridor_centering
