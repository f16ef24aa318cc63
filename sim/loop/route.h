#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/module.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The waypoints of a flight plan in order: the scenario's route, then its goal. Without both, the start is held.
class Route {
 public:
  explicit Route(const Scenario& scenario);

  /// Returns the current waypoint.
  const avoidance::Goal& goal() const { return waypoints_[next_].goal; }
  bool on_last() const { return next_ + 1 == waypoints_.size(); }
  /// Advances to the next waypoint if the estimated position has reached this one (GoalConfig::holds); stays at the
  /// last.
  void update(const Eigen::Vector3d& p_WB_est);

 private:
  struct RouteWaypoint {
    avoidance::Goal goal;
    GoalConfig config;
  };
  std::vector<RouteWaypoint> waypoints_;
  size_t next_ = 0;
};

inline Route::Route(const Scenario& scenario) {
  const auto add = [this](const GoalConfig& goal) { waypoints_.push_back({{goal.p_WG(), goal.heading_rad}, goal}); };
  for (const GoalConfig& goal : scenario.route) add(goal);
  if (scenario.goal) add(*scenario.goal);
  if (waypoints_.empty()) waypoints_.push_back({{scenario.start.p_WB(), scenario.start.heading_rad}, {}});
}

inline void Route::update(const Eigen::Vector3d& p_WB_est) {
  if (!on_last() && waypoints_[next_].config.holds(p_WB_est)) ++next_;
}

}  // namespace hedgehop::sim
