#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "avoidance/stereo_corridor/corridor_search.h"
#include "sim/fields/field.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo_corridor {

/// Additions of the modified law. Each can be switched off to measure its effect.
struct Additions {
  bool goal_first = true;  ///< goal_seeking.h, stopping_speed.h, climb.h, retreat.h
  bool memory = true;      ///< stereo::PassedObstacles
  bool sky = true;         ///< vision::stereo::SkyAmong::all, in a smoothed image
};

/// Treatment of a region without matches.
enum class Unknown { free, blocked };

/// Flies through corridors that are free in the depth image. Source: [Andert2007] sec. 3 and 4: corridor_search.h. The
/// modified law adds the goal, memory and deceleration.
struct StereoCorridorConfig {
  static constexpr std::string_view kName = "stereo_corridor";
  static constexpr std::string_view kMeaning =
      "flies through corridors that are free in the depth image of a stereo pair";

  Law law = Law::modified;
  bool follow_path = false;
  Additions additions;
  Unknown unknown = Unknown::free;
  stereo::DisparitySource::From depth = stereo::DisparitySource::From::stereo;
  vision::stereo::StereoMatcherConfig stereo;
  int speck_px = 60;
  int sky_texture = 6;       ///< tau_texture
  int sky_brightness = 140;  ///< tau_brightness
  CorridorSize corridor;     ///< r and tau_target
  double speed_mps = 5.0;
  double climb_rate_mps = 1.0;
  double lowest_m = 2.0;
  double yaw_rate_radps = 0.3490658503988659;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<StereoCorridorConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "published: keep the direction of flight while it is free; modified: with the additions goal_first, "
                "memory and sky"});
  v("follow_path", c.follow_path,
    {.meaning = "published: fly along the straight path from the start to the goal while its corridor is free, as the "
                "paper's aircraft; otherwise the flight has no path, only the direction in which it flies"});
  v("goal_first", c.additions.goal_first,
    {.meaning = "modified: fly to the goal if its direction is free, decelerate near it, near obstacles ahead and "
                "to climb, and turn back to a missed goal"});
  v("memory", c.additions.memory, {.meaning = "modified: remember obstacles that have left the image"});
  v("sky", c.additions.sky, {.meaning = "modified: search for sky also among matched pixels, in a smoothed image"});
  v("unknown", c.unknown,
    {.choices = {"free", "blocked"},
     .meaning = "modified: treatment of a square of 8 px without matches that is not sky; blocked stops in front of "
                "plain walls"});
  v("depth", c.depth,
    {.choices = {"stereo", "camera"},
     .meaning =
         "source of depth: matched cameras 'left' and 'right', or a camera 'depth' with the lens and pose of 'left'"});
  v("stereo", c.stereo, {.meaning = "matching of the pair"});
  v("speck", c.speck_px,
    {.unit = "px", .at_least = 0, .meaning = "minimum size of a disparity segment; smaller ones are removed"});
  v("sky_texture", c.sky_texture,
    {.at_least = 0,
     .at_most = 256,
     .meaning = "upper limit of the difference of a sky pixel to the pixel on its left"});
  v("sky_brightness", c.sky_brightness,
    {.at_least = 0, .at_most = 256, .meaning = "lower limit of the brightness of sky"});
  v("corridor_radius", c.corridor.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "radius of the cylinder that must be free"});
  v("target_distance", c.corridor.target_m,
    {.unit = "m", .above = 0.0, .meaning = "distance up to which a corridor must be free"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed along a free corridor"});
  v("climb_rate", c.climb_rate_mps,
    {.unit = "m/s",
     .above = 0.0,
     .meaning =
         "modified: maximum climb rate of the autopilot; along a steep corridor the vehicle flies so slowly that "
         "it suffices"});
  v("lowest", c.lowest_m, {.unit = "m", .at_least = 0.0, .meaning = "minimum altitude, above the scene's origin"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "turn rate if no corridor is free"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_stereo_corridor(const StereoCorridorConfig& config);

}  // namespace hedgehop::avoidance::stereo_corridor
