#include "sim/verdict/reaction.h"

#include <algorithm>

#include "sim/collision/proximity.h"

namespace hedgehop::sim {
namespace {

/// Attitude of 3-2-1 angles.
Eigen::Quaterniond attitude(const Eigen::Vector3d& rpy_rad) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return AngleAxisd(rpy_rad.z(), Vector3d::UnitZ()) * AngleAxisd(rpy_rad.y(), Vector3d::UnitY()) *
         AngleAxisd(rpy_rad.x(), Vector3d::UnitX());
}

/// Steps forward by the time that the clearance lasts at the greatest closing speed, so that nothing is stepped over.
std::optional<double> time_to_collision_s(CollisionWorld& world, const scenes::Scene& scene, Eigen::Isometry3d X_WB,
                                          const Eigen::Vector3d& v_WB_W, double t_s, double horizon_s) {
  constexpr double kContactM = 1e-3, kStillMps = 1e-3, kShortestS = 1e-4, kLongestS = 0.1;
  const Eigen::Vector3d start_W = X_WB.translation();
  for (double after_s = 0.0; after_s <= horizon_s;) {
    double mover_mps = 0.0;
    for (const scenes::Mover& mover : scene.movers) {
      mover_mps = std::max(mover_mps, scenes::v_WM(mover.motion, t_s + after_s).norm());
    }
    const double closing_mps = std::max(kStillMps, v_WB_W.norm() + mover_mps);
    X_WB.translation() = start_W + after_s * v_WB_W;
    const double reach_m = closing_mps * horizon_s + kContactM;
    const double clearance_m = world.query(X_WB, reach_m, t_s + after_s).obstacle_clearance_m;
    if (clearance_m <= kContactM) return after_s;
    // A mover may set off meanwhile, so no step is long where there is one.
    const double step_s = std::max(kShortestS, clearance_m / closing_mps);
    after_s += scene.movers.empty() ? step_s : std::min(step_s, kLongestS);
  }
  return {};
}

}  // namespace

std::optional<double> time_to_collision_s(const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
                                          const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& v_WB_W, double t_s,
                                          double horizon_s) {
  CollisionWorld world(scene, hull);
  return time_to_collision_s(world, scene, X_WB, v_WB_W, t_s, horizon_s);
}

std::optional<double> time_to_collision_at_reaction_s(const Flight& flight, const scenes::Scene& scene,
                                                      const std::vector<dynamics::HullPart>& hull) {
  constexpr double kHorizonS = 10.0, kSameTickS = 1e-6;
  const bool collided = flight.result.outcome == Outcome::collided;
  std::optional<double> least_s;
  bool foreseen = false;  // a collision, at a reaction that took effect not long before the contact
  CollisionWorld world(scene, hull);
  for (size_t i = 1; i < flight.decisions.size(); ++i) {
    const DecisionRow& decision = flight.decisions[i];
    if (decision.status == "cruise" || decision.status == flight.decisions[i - 1].status) continue;
    const double effect_s = decision.t_s + flight.command_latency_s;
    const auto row = std::ranges::lower_bound(flight.trajectory, effect_s - kSameTickS, {}, &TrajectoryRow::t_s);
    if (row == flight.trajectory.end()) break;  // the flight was over before
    Eigen::Isometry3d X_WB(attitude(row->rpy_true));
    X_WB.translation() = row->p_WB_true;
    const auto left_s = time_to_collision_s(world, scene, X_WB, row->v_WB_W_true, row->t_s, kHorizonS);
    if (!left_s) continue;
    least_s = std::min(*left_s, least_s.value_or(kHorizonS));
    foreseen = foreseen || row->t_s >= flight.result.flight_time_s - kHorizonS;
  }
  if (collided && !foreseen) return 0.0;
  return least_s;
}

}  // namespace hedgehop::sim
