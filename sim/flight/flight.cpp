#include "sim/flight/flight.h"

#include <algorithm>

namespace hedgehop::sim {

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached:
      return "reached";
    case Outcome::collided:
      return "collided";
    case Outcome::timeout:
      return "timeout";
    case Outcome::fault:
      return "fault";
    case Outcome::link_lost:
      return "link_lost";
  }
  return "fault";
}

std::optional<Outcome> parse_outcome(std::string_view text) {
  for (const Outcome outcome :
       {Outcome::reached, Outcome::collided, Outcome::timeout, Outcome::fault, Outcome::link_lost}) {
    if (text == to_string(outcome)) return outcome;
  }
  return {};
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::failed:
      return "failed";
    case Verdict::unchecked:
      return "unchecked";
    case Verdict::fault:
      return "fault";
    case Verdict::not_flown:
      return "not_flown";
  }
  return "not_flown";
}

Verdict verdict_of(const FlightResult& result) {
  if (result.outcome == Outcome::fault || result.outcome == Outcome::link_lost) return Verdict::fault;
  if (result.checks.empty()) return Verdict::unchecked;
  return std::ranges::all_of(result.checks, &CheckResult::passed) ? Verdict::passed : Verdict::failed;
}

const ClosestApproach& closest_approach(const FlightResult& result) {
  const bool by_obstacle = result.closest_obstacle.distance_m <= result.closest_ground.distance_m;
  return by_obstacle ? result.closest_obstacle : result.closest_ground;
}

std::string_view to_string(FigureKind kind) {
  switch (kind) {
    case FigureKind::judged:
      return "judged";
    case FigureKind::module:
      return "module";
    case FigureKind::wall_time:
      return "wall_time";
  }
  return "judged";
}

}  // namespace hedgehop::sim
