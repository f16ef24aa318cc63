#include "sim/loop/route.h"

namespace hedgehop::sim {

Route::Route(const Scenario& scenario) {
  const auto add = [this](const GoalConfig& place) { places_.push_back({{place.p_WG(), place.heading_rad}, place}); };
  for (const GoalConfig& place : scenario.route) add(place);
  if (scenario.goal) add(*scenario.goal);
  if (places_.empty()) places_.push_back({{scenario.start.p_WB(), scenario.start.heading_rad}, {}});
}

void Route::update(const Eigen::Vector3d& p_WB_est) {
  if (!on_last() && places_[next_].config.holds(p_WB_est)) ++next_;
}

}  // namespace hedgehop::sim
