#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/module.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The places of a flight plan, one after the other: those of the scenario's route, then its goal. Without any, the
/// start is held.
class Route {
 public:
  explicit Route(const Scenario& scenario);

  /// Where to fly now.
  const avoidance::Goal& goal() const { return places_[next_].goal; }
  bool on_last() const { return next_ + 1 == places_.size(); }
  /// Advances to the next place once this one holds the estimated position (GoalConfig::holds); never past the last.
  void update(const Eigen::Vector3d& p_WB_est);

 private:
  struct Place {
    avoidance::Goal goal;
    GoalConfig config;
  };
  std::vector<Place> places_;
  size_t next_ = 0;
};

}  // namespace hedgehop::sim
