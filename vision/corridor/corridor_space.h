#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "sim/fields/field.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// How the free width ahead is measured; all of it is ours.
struct GapConfig {
  double behind_m = 0.4, ahead_m = 2.0;  ///< from the camera
  double slice_m = 0.4;
  double share = 0.2;                                  ///< of a slice's points that may lie nearer: wrong ones
  double least_rad = 15.0 * std::numbers::pi / 180.0;  ///< from the direction of travel: nearer, the flow is noise
  int least = 6;                                       ///< points that a slice, or a free time, needs
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GapConfig> auto& c) {
  v("behind", c.behind_m, {.unit = "m", .at_least = 0.0, .meaning = "how far behind the camera the gap is measured"});
  v("ahead", c.ahead_m, {.unit = "m", .above = 0.0, .meaning = "how far ahead of the camera the gap is measured"});
  v("slice", c.slice_m, {.unit = "m", .above = 0.0, .meaning = "length of the slices in which the gap is measured"});
  v("share", c.share,
    {.at_least = 0.0, .below = 0.5, .meaning = "share of a slice's points, the nearest, left out as outliers"});
  v("least_angle", c.least_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 90.0,
     .meaning = "points closer to the direction of travel do not count for the gap"});
  v("least", c.least, {.at_least = 1, .meaning = "points that a slice must have to count"});
}

/// Free distance to the left and right over the measured length, m; NaN where no slice has enough points.
struct Gap {
  double left_m = 0.0, right_m = 0.0;
};
/// Returns the smallest free distance of all slices, on each side.
Gap gap_ahead(const std::vector<WallPoint>& points, const GapConfig& config);

/// Returns the time until `least` accepted points are met, s, by a body of the given half width that flies straight
/// on; +inf when it meets fewer. @param direction_H  direction of travel, not 0.
double free_time_s(const std::vector<WallPoint>& points, const Eigen::Vector2d& direction_H, double half_width_m,
                   int least);

/// Returns the direction of a corridor's walls, rad to the right of the heading, within `most_rad`: the one across
/// which the accepted points of each side scatter least about their median. 0 where a side has fewer than `least`.
/// Without this correction a heading oblique to the walls shifts the middle: points ahead lie nearer on one side and
/// farther on the other.
double wall_direction_rad(const std::vector<WallPoint>& points, double most_rad, int least);

/// Returns the points in frame H rotated to a direction, rad to the right of the heading.
std::vector<WallPoint> rotate_points(std::vector<WallPoint> points, double direction_rad);

}  // namespace hedgehop::vision::corridor
