#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "avoidance/landmark_map/course.h"
#include "avoidance/landmark_map/landmark_observer.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"

namespace hedgehop::avoidance::landmark_map {

/// Maps the corners that one camera detects, flies around the obstacles that they outline, and stops in front of walls
/// without corners. Source: [Shah2009] ch. 4. `law: published` is the thesis alone: its filter
/// (vision/landmarks/published_filter.h) and its flights, a circle (course.h) or straight ahead. The thesis leaves
/// avoidance and stopping to future work, ch. 7.
struct LandmarkMapModuleConfig {
  static constexpr std::string_view kName = "landmark_map";
  static constexpr std::string_view kMeaning =
      "maps the corners that one camera detects and flies around them; detects hardly any obstacle without corners";

  Law law = Law::modified;
  LandmarkObserverConfig observer;
  double speed_mps = 2.0;
  std::optional<Orbit> orbit;
  double clearance_m = 6.0;
  double behind_m = 8.0;
  double time_to_contact_s = 5.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LandmarkMapModuleConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "published: the thesis's filter and flight; modified: also the camera's common error, confirmation, "
                "avoidance and stopping"});
  describe(v, c.observer);
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed along the course and around obstacles"});
  v("orbit", c.orbit, {.meaning = "circle to fly with the nose to its center, instead of a course to the goal"});
  v("clearance", c.clearance_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "distance between the vehicle's hull and the obstacles of the map; 0 maps without avoidance"});
  v("behind", c.behind_m,
    {.unit = "m", .at_least = 0.0, .meaning = "extent of obstacles behind their observed corners"});
  v("time_to_contact", c.time_to_contact_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "time to contact, from flow divergence, below which the flight stops; 0 disables this"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_landmark_map(const LandmarkMapModuleConfig& config);

}  // namespace hedgehop::avoidance::landmark_map
