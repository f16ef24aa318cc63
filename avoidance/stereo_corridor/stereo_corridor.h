#pragma once

#include <memory>
#include <string_view>

#include "avoidance/module.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "vision/stereo/corridor_targets.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo_corridor {

/// Flies through corridors that a stereo pair sees to be free.
/// Source: [Andert2007] sec. 3 and 4; the parameters that it does not print are ours.
struct StereoCorridorConfig {
  static constexpr std::string_view kName = "stereo_corridor";
  static constexpr std::string_view kMeaning = "flies through corridors that a stereo pair sees to be free";

  vision::stereo::StereoMatcherConfig stereo;
  double disparity_noise_px = 0.0;
  int speck_difference16 = 16;  ///< tau_difference
  int speck_px = 60;
  int sky_texture = 6;       ///< tau_texture
  int sky_brightness = 140;  ///< tau_brightness
  vision::stereo::SkyAmong sky_among = vision::stereo::SkyAmong::all;
  double radius_m = 2.5;   ///< r
  double target_m = 30.0;  ///< tau_target
  double look_ahead_m = 30.0;
  double speed_mps = 5.0;
  int coarsest = 5, finest = 3;  ///< levels of the quadtree
  vision::stereo::NearbyLattice nearby;
  vision::stereo::TargetCost cost;
  stereo::PassedObstaclesConfig passed;
  double lowest_m = 2.0;
  double yaw_rate_radps = 0.3490658503988659;
};

template <class Visitor>
void describe(Visitor& v, StereoCorridorConfig& c) {
  v("stereo", c.stereo, {.meaning = "how the pair of cameras 'left' and 'right' is matched"});
  v("disparity_noise", c.disparity_noise_px,
    {.unit = "px",
     .at_least = 0.0,
     .meaning = "standard deviation of noise laid over every matched pixel; for experiments"});
  v("speck_difference", c.speck_difference16,
    {.at_least = 1,
     .meaning = "neighbors whose disparities differ by less, in sixteenths of a pixel, are one segment"});
  v("speck", c.speck_px, {.unit = "px", .at_least = 0, .meaning = "segments smaller than this are dropped"});
  v("sky_texture", c.sky_texture,
    {.at_least = 0, .at_most = 256, .meaning = "sky differs from the pixel to its left by less than this"});
  v("sky_brightness", c.sky_brightness, {.at_least = 0, .at_most = 256, .meaning = "sky is brighter than this"});
  v("sky_among", c.sky_among,
    {.choices = {"unknown", "all"}, .meaning = "sky is looked for where the matcher found nothing, or everywhere"});
  v("corridor_radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "of the cylinder that must be free"});
  v("target_distance", c.target_m, {.unit = "m", .above = 0.0, .meaning = "up to which a corridor must be free"});
  v("look_ahead", c.look_ahead_m, {.unit = "m", .above = 0.0, .meaning = "longest way to a target point"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "along a free corridor"});
  v("coarsest", c.coarsest, {.at_least = 0, .at_most = 10, .meaning = "level at which the quadtree search begins"});
  v("finest", c.finest, {.at_least = 0, .at_most = 10, .meaning = "level down to which it divides"});
  v("fine_step", c.nearby.fine_step_px, {.unit = "px", .at_least = 1, .meaning = "lattice close to the last target"});
  v("coarse_step", c.nearby.coarse_step_px, {.unit = "px", .at_least = 1, .meaning = "lattice in the ring round that"});
  v("fine_radius", c.nearby.fine_radius_px,
    {.unit = "px", .at_least = 0, .meaning = "of the circle close to the last target"});
  v("coarse_radius", c.nearby.coarse_radius_px, {.unit = "px", .at_least = 0, .meaning = "outer radius of the ring"});
  v("cost_depth", c.cost.depth_per_m,
    {.at_most = 0.0, .meaning = "cost of a target per meter of depth; below 0 prefers what is far"});
  v("cost_azimuth", c.cost.azimuth_per_rad, {.at_least = 0.0, .meaning = "cost per radian of a change of azimuth"});
  v("cost_elevation", c.cost.elevation_per_rad,
    {.at_least = 0.0, .meaning = "cost per radian of a change of elevation"});
  v("passed", c.passed, {.meaning = "near obstacles that have left the image"});
  v("lowest", c.lowest_m, {.unit = "m", .at_least = 0.0, .meaning = "it never flies lower, above the scene's origin"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "at which it looks round when no corridor is free"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_stereo_corridor(const StereoCorridorConfig& config);

}  // namespace hedgehop::avoidance::stereo_corridor
