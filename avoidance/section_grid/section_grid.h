#pragma once

#include <memory>
#include <string_view>

#include "avoidance/module.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "vision/sections/section_search.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::section_grid {

/// How a vehicle moves about what its sections show. Source: [Perez2018] sec. on movement.
struct SectionPilotConfig {
  /// What it does about a threat ahead; all but `waypoint` are beyond the paper.
  enum class Answer { waypoint, heading, sideways, climb, combined };
  Answer answer = Answer::waypoint;
  double keep_share = 0.01;
  double aligned_rad = 0.17453292519943295;
  double arrived_m = 1.0;
  double lowest_m = 2.0;
  double yaw_rate_radps = 0.5235987755982988;
};

template <class Visitor>
void describe(Visitor& v, SectionPilotConfig& c) {
  v("answer", c.answer,
    {.choices = {"waypoint", "heading", "sideways", "climb", "combined"},
     .meaning =
         "a position in the section's direction; the same on the level; aside without turning; straight up; aside "
         "and up"});
  v("keep_share", c.keep_share,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "share of threats up to which a way is kept, and the way to the goal counts as free again"});
  v("aligned", c.aligned_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 90.0,
     .meaning = "the vehicle moves once its nose is turned to within this"});
  v("arrived", c.arrived_m,
    {.unit = "m", .above = 0.0, .meaning = "distance at which a position aside counts as reached"});
  v("lowest", c.lowest_m,
    {.unit = "m", .at_least = 0.0, .meaning = "no position aside lies lower, above the scene's origin"});
  v("yaw_rate", c.yaw_rate_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 360.0, .meaning = "at which it looks round when no section is free"});
}

/// Flies towards the emptiest of many overlapping sections of a depth image.
/// Source: [Perez2018] sec. on the selection of sections, and sec. on movement.
struct SectionGridConfig {
  static constexpr std::string_view kName = "section_grid";
  static constexpr std::string_view kMeaning =
      "flies towards the emptiest of many overlapping sections of a depth image";

  enum class Sight { stereo, truth };
  Sight sight = Sight::stereo;
  vision::stereo::StereoMatcherConfig stereo;
  int speck_px = 100;
  vision::sections::SectionGrid grid;
  double threshold_m = 9.144;  ///< 30 ft
  double threshold_time_s = 0.0;
  double most_share = 0.15;
  vision::sections::Unknown unknown = vision::sections::Unknown::free;
  stereo::PassedObstaclesConfig passed = {.radius_m = 0.0, .near_m = 9.144};
  SectionPilotConfig pilot;
};

template <class Visitor>
void describe(Visitor& v, SectionGridConfig& c) {
  v("sight", c.sight,
    {.choices = {"stereo", "truth"},
     .meaning =
         "depth by matching cameras 'left' and 'right', or, for experiments, from a camera 'depth' that knows it"});
  v("stereo", c.stereo, {.meaning = "how the pair is matched"});
  v("speck", c.speck_px,
    {.unit = "px", .at_least = 0, .meaning = "segments of disparity smaller than this are dropped"});
  v("rows", c.grid.rows, {.at_least = 1, .at_most = 101, .meaning = "rows of sections"});
  v("cols", c.grid.cols, {.at_least = 1, .at_most = 101, .meaning = "columns of sections"});
  v("width", c.grid.width_share, {.above = 0.0, .at_most = 1.0, .meaning = "of a section, as a share of the image's"});
  v("height", c.grid.height_share,
    {.above = 0.0, .at_most = 1.0, .meaning = "of a section, as a share of the image's"});
  v("grow", c.grid.grow_px,
    {.unit = "px",
     .at_least = 0,
     .at_most = 200,
     .meaning = "threats are widened by this to every side before they are counted, that thin ones weigh more"});
  v("threshold", c.threshold_m, {.unit = "m", .above = 0.0, .meaning = "what is nearer is a threat"});
  v("threshold_time", c.threshold_time_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "so is what the vehicle would touch within this time if it flew straight at it at its present speed; "
                "0: the threshold does not hang on speed"});
  v("most_share", c.most_share,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "share of threats from which on a section is no way out"});
  v("unknown", c.unknown, {.choices = {"free", "threat"}, .meaning = "what a pixel without depth counts as"});
  v("passed", c.passed, {.meaning = "what has left the image, which no way chosen meets where another is free"});
  describe(v, c.pilot);
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config);

}  // namespace hedgehop::avoidance::section_grid
