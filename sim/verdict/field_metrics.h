#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Returns metrics that compare flights of different modules; docs/metrics.md defines them. They depend on the true
/// path, never on wall time. Metrics that do not exist for a flight (no goal, no obstacle nearby) are omitted.
/// @param vehicle_radius_m  of the smallest vertical cylinder around the hull, > 0.
std::vector<MetricValue> field_metrics(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                       double vehicle_radius_m);

/// Returns the time until the hull contacts a solid if the vehicle keeps its velocity and attitude and movers continue
/// their motion, s; nullopt if there is no contact within `horizon_s`.
/// @param X_WB  pose. @param v_WB_W  velocity, m/s. @param t_s  present time, >= 0. @param horizon_s  > 0.
std::optional<double> time_to_collision_s(const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
                                          const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& v_WB_W, double t_s,
                                          double horizon_s);

/// Returns the minimum time to collision at the time of a reaction, up to ten seconds. A reaction is a decision whose
/// status differs from the previous one and is not "cruise". It takes effect Flight::command_latency_s later, and the
/// true state at that time is used. The value is 0 if the flight collides but no reaction in its last ten seconds
/// predicted a collision. nullopt if the flight does not collide and no reaction predicted a collision.
std::optional<double> time_to_collision_at_reaction_s(const Flight& flight, const scenes::Scene& scene,
                                                      const std::vector<dynamics::HullPart>& hull);

}  // namespace hedgehop::sim
