#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// How the free width ahead is measured. Not from the paper.
struct GapConfig {
  double behind_m = 0.4, ahead_m = 2.0;  ///< from the camera
  double slice_m = 0.4;
  double share = 0.2;  ///< share of a slice's points, the nearest, ignored as outliers
  double least_rad =
      15.0 * std::numbers::pi / 180.0;  ///< minimum angle from the direction of travel; noise dominates closer to it
  int least = 6;                        ///< minimum number of points for a slice or a free time
};

/// Free distance to the left and right over the measured length, m; NaN if no slice has enough points.
struct Gap {
  double left_m = 0.0, right_m = 0.0;
};
/// Returns the minimum free distance over all slices, on each side.
Gap gap_ahead(const std::vector<WallPoint>& points, const GapConfig& config);

/// Returns the time until a body of the given half width, flying straight, meets `min_count` accepted points, s; +inf
/// if it meets fewer. @param direction_H  direction of travel, not 0.
double free_time_s(const std::vector<WallPoint>& points, const Eigen::Vector2d& direction_H, double half_width_m,
                   int min_count);

/// Returns the direction of a corridor's walls, rad to the right of the heading, within `max_rad`. It minimizes the
/// scatter of each side's accepted points about their median, measured across the direction. Returns 0 if a side has
/// fewer than `min_count` points. Without this correction a heading oblique to the walls shifts the measured
/// centerline, because points ahead are closer on one side and farther away on the other.
double wall_direction_rad(const std::vector<WallPoint>& points, double max_rad, int min_count);

/// Returns the points in frame H rotated to a direction, rad to the right of the heading.
std::vector<WallPoint> rotate_points(std::vector<WallPoint> points, double direction_rad);

}  // namespace hedgehop::vision::corridor
