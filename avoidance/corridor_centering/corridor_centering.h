#pragma once

#include <memory>
#include <numbers>
#include <string_view>

#include "avoidance/corridor_centering/centering_law.h"
#include "avoidance/corridor_centering/corridor_sight.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::corridor_centering {

/// Keeps to the middle of a corridor by the flow that a fisheye sees of its walls.
/// Source: [Zingg2010] sec. IV, law `printed` sec. V-C; law `pursuit` and the care for what lies ahead are ours.
struct CorridorCenteringConfig {
  static constexpr std::string_view kName = "corridor_centering";
  static constexpr std::string_view kMeaning =
      "keeps to a corridor's middle by the flow that a fisheye sees of its walls";

  enum class Law { printed, pursuit };
  Law law = Law::pursuit;
  CorridorSightConfig sight;
  double patience_s = 0.45;

  CenteringGains gains;
  double sample_s = 0.5;                              ///< [Zingg2010] sec. V-C
  double pitch_rad = 0.5 * std::numbers::pi / 180.0;  ///< nose down; [Zingg2010] sec. V-C

  vision::corridor::GapConfig gap;
  double smoothing_s = 0.25;
  double lookahead_m = 1.5;
  double heading_s = 0.7;
  double most_course_rad = 50.0 * std::numbers::pi / 180.0;
  SpeedLimits speed;
  double probe_mps = 0.3;
  double probe_s = 3.0;
  double margin_m = 0.15;
  double yaw_rate_radps = 0.5235987755982988;
};

template <class Visitor>
void describe(Visitor& v, CorridorCenteringConfig& c) {
  v("law", c.law,
    {.choices = {"printed", "pursuit"},
     .meaning = "printed: roll and turn rate by the paper's controller, at constant pitch; pursuit: fly towards the "
                "middle of the gap ahead"});
  v("sight", c.sight, {.meaning = "from the images of camera 'fisheye' to the places of walls"});
  v("patience", c.patience_s,
    {.unit = "s", .at_least = 0.0, .meaning = "how long it flies by what it saw last when nothing new is known"});
  v("gains", c.gains, {.meaning = "printed: the controller's"});
  v("sample", c.sample_s, {.unit = "s", .above = 0.0, .meaning = "printed: the controller's sampling time"});
  v("pitch", c.pitch_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 20.0, .meaning = "printed: nose held down by this"});
  v("gap", c.gap, {.meaning = "pursuit: how the free width ahead is measured"});
  v("smoothing", c.smoothing_s,
    {.unit = "s", .at_least = 0.0, .meaning = "pursuit: time constant with which the gap follows what is seen"});
  v("lookahead", c.lookahead_m, {.unit = "m", .above = 0.0, .meaning = "pursuit: distance of the point flown to"});
  v("heading_time", c.heading_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "pursuit: time constant with which the nose follows the course; turning slowly keeps the flow clean"});
  v("most_course", c.most_course_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 80.0,
     .meaning = "pursuit: greatest angle from the heading to the course"});
  v("limits", c.speed, {.meaning = "pursuit: speed by clearance and by the time to contact ahead"});
  v("probe_speed", c.probe_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "pursuit: least speed, at which it sets off where corners are seen"});
  v("probe_time", c.probe_s, {.unit = "s", .above = 0.0, .meaning = "longest time it does so while nothing is known"});
  v("margin", c.margin_m, {.unit = "m", .at_least = 0.0, .meaning = "pursuit: clearance of the hull to be kept"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "pursuit: at which it turns away when blocked ahead"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_corridor_centering(const CorridorCenteringConfig& config);

}  // namespace hedgehop::avoidance::corridor_centering
