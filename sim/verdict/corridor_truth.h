#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/worlds/corridor.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

/// What a module that centers itself in a corridor cannot know: where the middle is.
namespace hedgehop::sim {

/// Where a place lies between a corridor's walls, doorways and pillars left aside.
struct CorridorPlace {
  double left_m = 0.0, right_m = 0.0;  ///< to the walls, square to the section; < 0 beyond one
  double along_m = 0.0;                ///< from the corridor's beginning
};

/// Returns the place in the section whose middle line is nearest.
CorridorPlace corridor_place(const scenes::worlds::CorridorPlan& plan, const Eigen::Vector2d& p_NE);

/// Returns figures of a flight through a corridor; none in another scene:
/// - off_middle_mean_m, off_middle_max_m, and off_middle_after_15m_m, the largest from 15 m of corridor past the start
///   on: the vehicle's distance from the middle;
/// - for a module with a signal `centering_error`, centering_error_mean, _median, _max: half its difference from the
///   truth, so as a share of the corridor's width, over all decisions that know it, and centering_known_share, of
///   all decisions: a module that says nothing errs in nothing.
/// Source: [Zingg2010] sec. V-B and fig. 9.
std::vector<MetricValue> corridor_metrics(const Scenario& scenario, const Flight& flight);

}  // namespace hedgehop::sim
