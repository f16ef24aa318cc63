#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/flight/flight.h"

/// How much time a module left itself.
namespace hedgehop::sim {

/// Returns how long the hull would take to contact a solid if the vehicle kept its velocity and attitude, while movers
/// go on as they do, s; none within `horizon_s`.
/// @param X_WB  pose, @param v_WB_W  velocity, m/s. @param t_s  when, >= 0. @param horizon_s  > 0.
std::optional<double> time_to_collision_s(const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
                                          const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& v_WB_W, double t_s,
                                          double horizon_s);

/// Returns the least time to a collision that was left when a reaction took effect, within ten seconds. A reaction is
/// every decision whose status differs from that of the one before and is not "cruise"; it takes effect when its
/// command does, Flight::command_latency_s later, and the true state of then counts. A flight that collides though no
/// collision was foreseen so at any reaction of its last ten seconds has 0, the worst. None for a flight without
/// collision where none was near at any reaction.
std::optional<double> time_to_collision_at_reaction_s(const Flight& flight, const scenes::Scene& scene,
                                                      const std::vector<dynamics::HullPart>& hull);

}  // namespace hedgehop::sim
