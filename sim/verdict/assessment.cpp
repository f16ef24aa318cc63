#include "sim/verdict/assessment.h"

#include <algorithm>
#include <utility>

#include "sim/verdict/checks.h"
#include "sim/verdict/corridor_truth.h"
#include "sim/verdict/field_metrics.h"
#include "sim/verdict/reaction.h"

namespace hedgehop::sim {
namespace {

/// Radius of the widest upright disc of a hull, m; 0 without one.
double rotor_radius_m(const std::vector<dynamics::HullPart>& hull) {
  double radius_m = 0.0;
  for (const dynamics::HullPart& part : hull) {
    if (part.shape == dynamics::HullPart::Shape::cylinder) radius_m = std::max(radius_m, part.half_extents_m.x());
  }
  return radius_m;
}

}  // namespace

void assess(const Scenario& scenario, const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
            Flight& flight) {
  constexpr double kBesideStartM = 1.0;
  const double altitude_m = scenario.start.altitude_m;
  flight.result.scene = scenes::scene_figures(scene, {altitude_m - kBesideStartM, altitude_m + kBesideStartM});
  for (MetricValue& metric : field_metrics(scenario, flight, scene, dynamics::radius_m(hull))) {
    flight.result.metrics.push_back(std::move(metric));
  }
  if (const auto left_s = time_to_collision_at_reaction_s(flight, scene, hull)) {
    flight.result.metrics.push_back({"time_to_collision_at_reaction_s", *left_s, "s"});
  }
  for (const MetricValue& metric : corridor_metrics(scenario, flight)) flight.result.metrics.push_back(metric);
  flight.result.checks = evaluate_checks(scenario, flight, scene, rotor_radius_m(hull));
}

}  // namespace hedgehop::sim
