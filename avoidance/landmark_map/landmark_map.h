#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "avoidance/landmark_map/course.h"
#include "avoidance/landmark_map/landmark_observer.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::landmark_map {

/// Maps the corners that one camera sees, flies around what they belong to, and stops before walls without corners.
/// Source: [Shah2009] ch. 4. `law: published` is the thesis alone: its filter (vision/landmarks/published_filter.h) and
/// its flights, a circle (orbit.h) or straight ahead; it leaves avoiding and stopping to others, ch. 7.
struct LandmarkMapModuleConfig {
  static constexpr std::string_view kName = "landmark_map";
  static constexpr std::string_view kMeaning =
      "maps the corners that one camera sees and flies around them; what has none it hardly sees";

  Law law = Law::modified;
  LandmarkObserverConfig sight;
  double speed_mps = 2.0;
  std::optional<Orbit> orbit;
  double clearance_m = 6.0;
  double behind_m = 8.0;
  double time_to_contact_s = 5.0;
};

template <class Visitor>
void describe(Visitor& v, LandmarkMapModuleConfig& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "the thesis's filter and flight alone; or with the camera's common error, confirmation, avoiding and "
                "stopping"});
  describe(v, c.sight);
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "along the course and around obstacles"});
  v("orbit", c.orbit, {.meaning = "a circle to fly, nose to its middle, instead of a course to the goal"});
  v("clearance", c.clearance_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "kept between the vehicle's hull and the obstacles of the map; 0 maps without avoiding"});
  v("behind", c.behind_m,
    {.unit = "m", .at_least = 0.0, .meaning = "obstacles reach so far behind the corners seen of them"});
  v("time_to_contact", c.time_to_contact_s,
    {.unit = "s", .at_least = 0.0, .meaning = "flow divergence of a nearer contact stops the flight; 0 never"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_landmark_map(const LandmarkMapModuleConfig& config);

}  // namespace hedgehop::avoidance::landmark_map
