#pragma once

#include <memory>
#include <string_view>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "vision/sections/section_search.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::section_grid {

/// Where to go for a threat ahead. All but `waypoint` are ours; [Perez2018] sec. VII leaves them to a trade study.
enum class Answer { waypoint, heading, sideways, climb, combined };

/// Flies towards the emptiest of many overlapping sections of a depth image.
/// Source: [Perez2018] sec. V: section_law.h. Law `modified` (section_pilot.h) keeps a path that it has chosen.
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
void describe(Visitor& v, SectionGridConfig& c) {
  v("law", c.law,
    {.choices = {"published", "modified"},
     .meaning =
         "published: go to every new section that is the emptiest; modified: keep a path until it fills up, and what "
         "the keys marked so add"});
  v("depth", c.depth,
    {.choices = {"stereo", "camera"}, .meaning = "by matching cameras 'left' and 'right', or from a camera 'depth'"});
  v("stereo", c.stereo, {.meaning = "how the pair is matched"});
  v("speck", c.speck_px,
    {.unit = "px", .at_least = 0, .meaning = "segments of disparity smaller than this are dropped"});
  v("sections", c.sections, {.at_least = 1, .at_most = 101, .meaning = "rows of sections, and columns"});
  v("overlapping", c.overlapping,
    {.meaning = "sections of 628 x 252 of 1280 x 720 px, as printed; else they divide the image and do not overlap"});
  v("threshold", c.threshold_m, {.unit = "m", .above = 0.0, .meaning = "what is nearer is a threat"});
  v("lowest", c.lowest_m,
    {.unit = "m", .at_least = 0.0, .meaning = "no position aside lies lower, above the scene's origin"});
  v("grow", c.grow_px,
    {.unit = "px",
     .at_least = 0,
     .at_most = 200,
     .meaning =
         "modified: threats are widened by this to every side before they are counted, that thin ones weigh more"});
  v("threshold_time", c.threshold_time_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning =
         "modified: also a threat is what the vehicle would hit within this time, straight ahead at its speed; 0: "
         "the threshold does not depend on speed"});
  v("keep_share", c.keep_share,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning =
         "modified: share of threats up to which a path is kept, and the path to the goal counts as free again"});
  v("passed_radius", c.passed_radius_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "modified: of the cylinder that must be free of what has left the image; 0 remembers nothing"});
  v("unknown", c.unknown,
    {.choices = {"free", "threat"},
     .meaning = "modified: what a pixel without depth counts as; threat stops before plain walls, and before the sky"});
  v("answer", c.answer,
    {.choices = {"waypoint", "heading", "sideways", "climb", "combined"},
     .meaning =
         "modified: a position in the section's direction; the same on the level; aside without turning; straight "
         "up; aside and up"});
}

/// Throws std::invalid_argument on a bad config.
std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config);

}  // namespace hedgehop::avoidance::section_grid
