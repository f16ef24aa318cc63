#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::local_map {

/// Flies only through space that it has seen to be free: stereo depth (vision/mapping/depth_blocks.h), a map that moves
/// along (vision/mapping/occupancy_map.h), routes to the goal through it (route_field.h), and of those only what ends
/// in a full stop within known free space (stop_planner.h). Assumed without being seen: the hull's own volume is free;
/// so is, once, where the flight begins, a strip ahead, up to where the camera sees the vehicle's whole width.
/// Beside and behind is unknown until it is looked at.
struct LocalMapConfig {
  static constexpr std::string_view kName = "local_map";
  static constexpr std::string_view kMeaning = "flies only through space that it has seen to be free";

  stereo::DisparitySource::From depth = stereo::DisparitySource::From::stereo;
  std::vector<std::string> pairs;  ///< beside the first
  vision::stereo::StereoMatcherConfig stereo{
      .method = vision::stereo::StereoMatcherConfig::Method::block, .disparities_px = 64, .block_px = 11};
  bool sky = true;
  double noise_px = 0.5;
  double voxel_m = 0.3;
  double memory_s = 30.0;
  double speed_mps = 8.0;
  double margin_m = 0.15;
  double margin_time_s = 0.25;
  double braking_share = 0.7;
  double delay_s = 0.25;
  double stare_s = 2.0;
};

template <class Visitor>
void describe(Visitor& v, LocalMapConfig& c) {
  v("depth", c.depth,
    {.choices = {"stereo", "camera"}, .meaning = "by matching cameras 'left' and 'right', or from a camera 'depth'"});
  v("pairs", c.pairs,
    {.meaning = "further pairs, or depth cameras, in any direction, by their role in the rig: aft for aft_left and "
                "aft_right"});
  v("stereo", c.stereo, {.meaning = "how the pairs are matched"});
  v("sky", c.sky,
    {.meaning = "recognize sky above a horizon of far ground as free; else what is not matched is unknown"});
  v("noise", c.noise_px,
    {.unit = "px",
     .above = 0.0,
     .at_most = 4.0,
     .meaning = "1-sigma of a disparity; space is free up to two of them less"});
  v("voxel", c.voxel_m, {.unit = "m", .at_least = 0.1, .at_most = 2.0, .meaning = "edge of a voxel of the map"});
  v("memory", c.memory_s,
    {.unit = "s",
     .at_least = 1.0,
     .meaning = "after which what is out of view is unknown again, as the position drifts"});
  v("speed", c.speed_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "where nothing is near; the vehicle's limit holds, too"});
  v("margin", c.margin_m,
    {.unit = "m", .at_least = 0.0, .meaning = "beside the hull that stays free of obstacles, standing"});
  v("margin_time", c.margin_time_s, {.unit = "s", .at_least = 0.0, .meaning = "by which the margin grows with speed"});
  v("braking", c.braking_share,
    {.above = 0.0, .at_most = 1.0, .meaning = "share of the vehicle's greatest acceleration that planned stops use"});
  v("delay", c.delay_s,
    {.unit = "s", .at_least = 0.0, .meaning = "from an image to the first effect of what is decided on it"});
  v("stare", c.stare_s,
    {.unit = "s",
     .above = 0.0,
     .meaning = "for how long it looks at what stays unknown before it takes that for an obstacle"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_local_map(const LocalMapConfig& config);

}  // namespace hedgehop::avoidance::local_map
