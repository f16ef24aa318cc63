#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "sim/fields/field.h"
#include "vision/sections/section_search.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::section_grid {

/// Response to a threat ahead. Only `waypoint` is from the paper; [Perez2018] sec. VII leaves the others to a trade
/// study.
enum class Answer { waypoint, heading, sideways, climb, combined };

/// Flies towards the emptiest of many overlapping sections of a depth image. Source: [Perez2018] sec. V: section_law.h.
/// The modified law (section_pilot.h) keeps a path that it has chosen.
struct SectionGridConfig {
  static constexpr std::string_view kName = "section_grid";
  static constexpr std::string_view kMeaning =
      "flies towards the emptiest of many overlapping sections of a depth image";

  Law law = Law::modified;
  stereo::DisparitySource::From depth = stereo::DisparitySource::From::stereo;
  vision::stereo::StereoMatcherConfig stereo;
  int speck_px = 100;
  int sections = 17;  ///< [Perez2018] sec. V-B
  bool overlapping = true;
  double threshold_m = 9.144;  ///< 30 ft, [Perez2018] sec. V-C
  double lowest_m = 2.0;

  int grow_px = 0;
  double threshold_time_s = 0.0;
  double keep_share = 0.01;
  double passed_radius_m = 0.0;
  vision::sections::UnknownDepth unknown = vision::sections::UnknownDepth::free;
  Answer answer = Answer::waypoint;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SectionGridConfig> auto& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning = "published: fly to every new emptiest section; modified: keep a path until it fills up, and use the "
                "keys marked 'modified'"});
  v("depth", c.depth,
    {.choices = {"stereo", "camera"},
     .meaning = "source of depth: matched cameras 'left' and 'right', or a camera 'depth'"});
  v("stereo", c.stereo, {.meaning = "matching of the pair"});
  v("speck", c.speck_px,
    {.unit = "px", .at_least = 0, .meaning = "minimum size of a disparity segment; smaller ones are removed"});
  v("sections", c.sections, {.at_least = 1, .at_most = 101, .meaning = "number of rows, and of columns, of sections"});
  v("overlapping", c.overlapping,
    {.meaning = "sections of 628 x 252 px in an image of 1280 x 720 px, as published; otherwise sections that divide "
                "the image without overlap"});
  v("threshold", c.threshold_m, {.unit = "m", .above = 0.0, .meaning = "distance below which an obstacle is a threat"});
  v("lowest", c.lowest_m,
    {.unit = "m", .at_least = 0.0, .meaning = "minimum altitude of avoidance waypoints, above the scene's origin"});
  v("grow", c.grow_px,
    {.unit = "px",
     .at_least = 0,
     .at_most = 200,
     .meaning =
         "modified: widening of threats to every side before counting, to increase the weight of thin obstacles"});
  v("threshold_time", c.threshold_time_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "modified: time to collision, straight ahead at the current speed, below which an obstacle is also a "
                "threat; 0 makes the threshold independent of speed"});
  v("keep_share", c.keep_share,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "modified: maximum share of threats at which a path is kept and the path to the goal counts as free"});
  v("passed_radius", c.passed_radius_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "modified: radius of the cylinder that must be free of obstacles that have left the image, and, before "
                "the route is resumed, also of those seen in the last second; 0 disables the test"});
  v("unknown", c.unknown,
    {.choices = {"free", "threat"},
     .meaning = "modified: treatment of a pixel without depth; threat stops in front of plain walls, and in front of "
                "the sky"});
  v("answer", c.answer,
    {.choices = {"waypoint", "heading", "sideways", "climb", "combined"},
     .meaning =
         "modified: waypoint flies to a position in the section's direction; heading does so at constant altitude; "
         "sideways moves aside without turning; climb moves straight up; combined moves aside and up"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config);

}  // namespace hedgehop::avoidance::section_grid
