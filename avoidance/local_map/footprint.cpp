#include "avoidance/local_map/footprint.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kUnsureS = 0.05;  // of flight, by which the map may be off where the unknown begins

}  // namespace

Fault Footprint::fault(const LevelSlice& slice, const Moment& moment, bool unknown_too) const {
  const double margin_m = clearance_.margin_m + clearance_.margin_s * moment.v_W.norm();
  const double unsure_m = kUnsureS * moment.v_W.norm();
  const bool close_by = clearance_.margin_m <= 0.5 * slice.cell_m();  // no more than what a look-up may err by
  Fault worst;
  for (const Outline::Disc& disc : swept_) {
    const Eigen::Vector2d p_W = moment.p_W + disc.p_H;
    const double keeps_m = disc.radius_m + margin_m;
    const double away_m = close_by ? slice.exactly_to_occupied_m(p_W, keeps_m) : slice.to_occupied_m(p_W);
    worst.occupied_m = std::max(worst.occupied_m, keeps_m - away_m);
    if (!unknown_too) continue;
    worst.unknown_m = std::max(worst.unknown_m, disc.radius_m - slice.to_unknown_m(p_W));
    worst.beside_unknown_m = std::max(worst.beside_unknown_m, disc.radius_m + unsure_m - slice.to_unknown_m(p_W));
  }
  return worst;
}

double Footprint::turn_as_far_as_free_rad(const LevelSlice& slice, const std::vector<Moment>& path, double from_rad,
                                          double to_rad) const {
  constexpr double kStepRad = 0.2, kSlackM = 0.02;
  const double turn_rad = std::remainder(to_rad - from_rad, 2.0 * M_PI);
  const int steps = outline_.discs().size() > 1 ? static_cast<int>(std::ceil(std::abs(turn_rad) / kStepRad)) : 0;
  const auto worst_of = [&](const Footprint& turned) {
    Fault most;
    for (const Moment& moment : path) {
      const Fault there = turned.fault(slice, moment, true);
      most.occupied_m = std::max(most.occupied_m, there.occupied_m);
      most.unknown_m = std::max(most.unknown_m, there.unknown_m);
    }
    return most;
  };
  Footprint turned = *this;
  turned.turn(from_rad, from_rad);
  const Fault before = worst_of(turned);
  for (int i = 1; i <= steps; ++i) {
    const double from = from_rad + turn_rad * (i - 1) / steps, to = from_rad + turn_rad * i / steps;
    turned.turn(from, to);
    const Fault then = worst_of(turned);
    if (then.occupied_m > before.occupied_m + kSlackM || then.unknown_m > before.unknown_m + kSlackM) return from;
  }
  return to_rad;
}

}  // namespace hedgehop::avoidance::local_map
