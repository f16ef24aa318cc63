#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "sim/fields/field.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::local_map {

/// Flies only through space that was observed as free: stereo depth (vision/mapping/depth_blocks.h), a map that moves
/// with the vehicle (vision/mapping/occupancy_map.h), routes to the goal (route_field.h), and of these only paths that
/// end in a full stop within known free space (stop_planner.h). Two volumes are assumed to be free without observation:
/// the hull and, at the start of the flight, a strip ahead up to the distance at which the camera sees the full width
/// of the vehicle. Space to the sides and behind is unknown until it is observed.
struct LocalMapConfig {
  static constexpr std::string_view kName = "local_map";
  static constexpr std::string_view kMeaning = "flies only through space that was observed as free";

  stereo::DisparitySource::From depth = stereo::DisparitySource::From::stereo;
  std::vector<std::string> pairs;  ///< in addition to the first
  vision::stereo::StereoMatcherConfig stereo{
      .method = vision::stereo::StereoMatcherConfig::Method::block, .disparities_px = 64, .block_px = 11};
  bool sky = true;
  bool lines = true;
  bool coarse = true;
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
void describe(Visitor& v, fields::ConfigOf<LocalMapConfig> auto& c) {
  v("depth", c.depth,
    {.choices = {"stereo", "camera", "motion"},
     .meaning =
         "source of depth: matched cameras 'left' and 'right', a camera 'depth', or a camera 'front' and its own "
         "motion"});
  v("pairs", c.pairs,
    {.meaning = "further pairs, or depth cameras, in any direction, as prefixes of their roles: aft for aft_left and "
                "aft_right"});
  v("stereo", c.stereo, {.meaning = "matching of the pairs"});
  v("sky", c.sky,
    {.meaning =
         "whether sky above a horizon of far ground is recognized as free; otherwise unmatched pixels are unknown"});
  v("lines", c.lines,
    {.meaning =
         "whether thin lines, such as branches and poles, are matched in addition to blocks; for depth: stereo"});
  v("coarse", c.coarse,
    {.meaning = "whether images that are largely unmatched are matched at lower resolutions, too; for depth: stereo"});
  v("noise", c.noise_px,
    {.unit = "px",
     .above = 0.0,
     .at_most = 4.0,
     .meaning = "1-sigma error of a disparity; space is free up to the disparity minus two sigma"});
  v("voxel", c.voxel_m, {.unit = "m", .at_least = 0.1, .at_most = 2.0, .meaning = "edge length of a voxel of the map"});
  v("memory", c.memory_s,
    {.unit = "s",
     .at_least = 1.0,
     .meaning = "time after which space out of view is unknown again, because the position drifts"});
  v("speed", c.speed_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "maximum speed without near obstacles; the vehicle's limit also applies"});
  v("margin", c.margin_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "minimum clearance around the hull at zero speed; if larger than a voxel, it is kept wherever a way of "
                "that width is known"});
  v("margin_time", c.margin_time_s, {.unit = "s", .at_least = 0.0, .meaning = "growth of the margin per speed"});
  v("braking", c.braking_share,
    {.above = 0.0, .at_most = 1.0, .meaning = "share of the vehicle's maximum acceleration that planned stops use"});
  v("delay", c.delay_s,
    {.unit = "s", .at_least = 0.0, .meaning = "time from an image to the first effect of its decision"});
  v("stare", c.stare_s,
    {.unit = "s", .above = 0.0, .meaning = "observation time after which unknown space counts as an obstacle"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_local_map(const LocalMapConfig& config);

}  // namespace hedgehop::avoidance::local_map
