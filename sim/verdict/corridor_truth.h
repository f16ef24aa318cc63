#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/worlds/corridor.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

/// True position of a vehicle in a corridor, for modules that center themselves in it.
namespace hedgehop::sim {

/// Position between the walls of a corridor, ignoring doorways and pillars.
struct CorridorPlace {
  double left_m = 0.0, right_m = 0.0;  ///< distances to the walls, normal to the section; < 0 beyond a wall
  double along_m = 0.0;                ///< from the start of the corridor
};

/// Returns the position in the section with the nearest center line.
CorridorPlace corridor_place(const scenes::worlds::CorridorPlan& plan, const Eigen::Vector2d& p_NE);

/// Returns the metrics of a flight through a corridor; empty in other scenes:
/// - off_middle_mean_m, off_middle_max_m, off_middle_after_15m_m: the vehicle's distance from the center line, its
/// mean,
///   its maximum, and its maximum beyond 15 m of corridor from the start;
/// - for a module with a signal `centering_error`: centering_error_mean, _median, _max, half the difference of the
/// signal
///   from the truth, a share of the corridor's width, over all decisions with a finite signal; centering_known_share,
///   the share of these decisions, because a module without an estimate has no error.
/// Source: [Zingg2010] sec. V-B and fig. 9.
std::vector<MetricValue> corridor_metrics(const Scenario& scenario, const Flight& flight);

}  // namespace hedgehop::sim
