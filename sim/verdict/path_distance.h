#pragma once

#include <vector>

#include "sim/scenario/reference_path.h"

/// Distances between two paths. Each path has at least one point; times increase.
namespace hedgehop::sim {

/// Returns the maximum distance at equal times over the points of both paths, m. Positions are linear between points;
/// before the first and after the last point, these points are used.
double max_deviation_m(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference);

/// Returns the position at a time, linear between points; the first or last point outside of the path's times.
Eigen::Vector3d position_at(const std::vector<TimedPoint>& path, double t_s);

/// Returns the first point of `flown` that is farther than a limit from the reference at the same time; null without
/// such a point.
const TimedPoint* first_beyond(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference,
                               double limit_m);

/// Returns the discrete Fréchet distance, m; times are not used.
/// Source: [EiterMannila1994] table 1.
double discrete_frechet_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b);

/// Returns the minimum mean distance of points paired by dynamic time warping, m. Each step is weighted by the points
/// it advances along both paths, so that all warpings have equal weight. Source: [SakoeChiba1978] sec. II, the
/// symmetric form.
double mean_warped_distance_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b);

}  // namespace hedgehop::sim
