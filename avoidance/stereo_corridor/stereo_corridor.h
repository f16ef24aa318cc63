#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "avoidance/stereo_corridor/corridor_search.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo_corridor {

/// Additions of the modified law. Each can be switched off to measure its effect.
struct Additions {
  bool goal_first = true;  ///< goal_first.h, turn_back.h
  bool memory = true;      ///< stereo::PassedObstacles
  bool sky = true;         ///< vision::stereo::SkyAmong::all, in a smoothed image
};

/// What a region without any match counts as.
enum class Unknown { free, blocked };

/// Flies through corridors that a depth image shows to be free.
/// Source: [Andert2007] sec. 3 and 4: corridor_search.h. Law `modified` adds the goal, memory and slowing down.
struct StereoCorridorConfig {
  static constexpr std::string_view kName = "stereo_corridor";
  static constexpr std::string_view kMeaning = "flies through corridors that a stereo pair sees to be free";

  Law law = Law::modified;
  Additions additions;
  Unknown unknown = Unknown::free;
  stereo::DisparitySource::From depth = stereo::DisparitySource::From::stereo;
  vision::stereo::StereoMatcherConfig stereo;
  int speck_px = 60;
  int sky_texture = 6;       ///< tau_texture
  int sky_brightness = 140;  ///< tau_brightness
  CorridorSize corridor;     ///< r and tau_target
  double speed_mps = 5.0;
  double lowest_m = 2.0;
  double yaw_rate_radps = 0.3490658503988659;
};

template <class Visitor>
void describe(Visitor& v, StereoCorridorConfig& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning =
         "published: keep the direction of flight while it is free; modified: with the additions goal_first, memory "
         "and sky"});
  v("goal_first", c.additions.goal_first,
    {.meaning = "modified: fly to the goal where its direction is free, slow down before it, turn back to one that was "
                "missed"});
  v("memory", c.additions.memory, {.meaning = "modified: remember obstacles that have left the image"});
  v("sky", c.additions.sky, {.meaning = "modified: look for sky among matched pixels too, in a smoothed image"});
  v("unknown", c.unknown,
    {.choices = {"free", "blocked"},
     .meaning =
         "modified: what a square of 8 px without any match and not sky counts as; blocked stops before plain walls"});
  v("depth", c.depth,
    {.choices = {"stereo", "camera"},
     .meaning = "by matching cameras 'left' and 'right', or from a camera 'depth' with the lens and pose of 'left'"});
  v("stereo", c.stereo, {.meaning = "how the pair is matched"});
  v("speck", c.speck_px, {.unit = "px", .at_least = 0, .meaning = "segments smaller than this are dropped"});
  v("sky_texture", c.sky_texture,
    {.at_least = 0, .at_most = 256, .meaning = "sky differs from the pixel to its left by less than this"});
  v("sky_brightness", c.sky_brightness, {.at_least = 0, .at_most = 256, .meaning = "sky is brighter than this"});
  v("corridor_radius", c.corridor.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "of the cylinder that must be free"});
  v("target_distance", c.corridor.target_m,
    {.unit = "m", .above = 0.0, .meaning = "up to which a corridor must be free"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "along a free corridor"});
  v("lowest", c.lowest_m, {.unit = "m", .at_least = 0.0, .meaning = "it never flies lower, above the scene's origin"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "at which it turns when no corridor is free"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_stereo_corridor(const StereoCorridorConfig& config);

}  // namespace hedgehop::avoidance::stereo_corridor
