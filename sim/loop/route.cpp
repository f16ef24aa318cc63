#include "sim/loop/route.h"

namespace hedgehop::sim {

Route::Route(const Scenario& scenario) {
  const auto add = [this](const GoalConfig& place) {
    places_.push_back({{place.p_WG(), place.heading_rad}, place.radius_m});
  };
  for (const GoalConfig& place : scenario.route) add(place);
  if (scenario.goal) add(*scenario.goal);
  if (places_.empty()) places_.push_back({{scenario.start.p_WB(), scenario.start.heading_rad}, 0.0});
}

void Route::update(const Eigen::Vector3d& p_WB_est) {
  const Place& place = places_[next_];
  if (!on_last() && (place.goal.p_WG - p_WB_est).head<2>().norm() <= place.radius_m) ++next_;
}

}  // namespace hedgehop::sim
