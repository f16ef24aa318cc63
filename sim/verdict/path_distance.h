#pragma once

#include <vector>

#include "sim/scenario/reference_path.h"

/// How far two paths of the same vehicle lie apart. Every list needs a point; times rise.
namespace hedgehop::sim {

/// Largest distance between the two at equal times, over the points of both, m: linear between the points of either,
/// its first and last point before and after it. So what ends first is compared by its end with all that the other does
/// later.
double largest_deviation_m(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference);

/// Shortest leash with which both can be walked from point to point, never back, m; times do not matter.
/// Source: [EiterMannila1994] table 1.
double discrete_frechet_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b);

/// Smallest mean distance of points that a warping of time pairs, m: each step weighs by the points it moves on along
/// both paths, so that all warpings have the same weight. Source: [SakoeChiba1978] sec. II, the symmetric form.
double mean_warped_distance_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b);

}  // namespace hedgehop::sim
