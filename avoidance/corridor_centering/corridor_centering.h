#pragma once

#include <memory>
#include <numbers>
#include <string_view>

#include "avoidance/corridor_centering/centering_law.h"
#include "avoidance/law.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::corridor_centering {

/// Keeps to the middle of a corridor by the flow that a fisheye sees of its walls.
/// Source: [Zingg2010] sec. IV, and sec. V-C: centering_law.h. Law `modified`: pursuit.h.
struct CorridorCenteringConfig {
  static constexpr std::string_view kName = "corridor_centering";
  static constexpr std::string_view kMeaning =
      "keeps to a corridor's middle by the flow that a fisheye sees of its walls";

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
void describe(Visitor& v, CorridorCenteringConfig& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "published: roll and turn rate by the paper's controller, at constant pitch; modified: fly towards the "
                "middle of the gap ahead, measured across the walls' direction, and turn away from what blocks it"});
  v("attitude_lag", c.attitude_lag_s,
    {.unit = "s", .at_least = 0.0, .at_most = 0.1, .meaning = "lag of the attitude estimate, which is the gyros'"});
  v("probe_time", c.probe_s, {.unit = "s", .above = 0.0, .meaning = "longest time it flies while nothing is known"});
  v("gains", c.gains, {.meaning = "published: the controller's"});
  v("sample", c.sample_s, {.unit = "s", .above = 0.0, .meaning = "published: the controller's sampling time"});
  v("pitch", c.pitch_rad, {.unit = "deg", .at_least = 0.0, .at_most = 20.0, .meaning = "published: nose down by this"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "modified: where nothing is near"});
  v("braking", c.braking_mps2, {.unit = "m/s^2", .above = 0.0, .meaning = "modified: deceleration counted on"});
  v("lookahead", c.lookahead_m, {.unit = "m", .above = 0.0, .meaning = "modified: distance of the point flown to"});
  v("margin", c.margin_m, {.unit = "m", .at_least = 0.0, .meaning = "modified: clearance of the hull that is kept"});
  v("probe_speed", c.probe_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "modified: least speed, also while nothing is known"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s",
     .above = 0.0,
     .at_most = 360.0,
     .meaning = "modified: at which it turns away when blocked ahead"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_corridor_centering(const CorridorCenteringConfig& config);

}  // namespace hedgehop::avoidance::corridor_centering
