#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::flow_balance {

using Walls = std::vector<vision::TexturedPlane>;
/// Side of a camera's image in flights of points.
constexpr int kSizePx = 96;

inline const vision::WaveTexture& wavy_texture() {
  static const vision::WaveTexture made(4, 0.5, 4.0, 6);
  return made;
}

/// A point mass that follows a module's commands with a lag, with images of small cameras at 10 Hz.
struct PointFlight {
  double least_clearance_m = 1e9;
  std::vector<Eigen::Vector2d> path;  ///< north and east, m
  std::vector<Metric> metrics;
};

/// Flies from rest at `p`.  @param clearance  distance of a position from the nearest obstacle, m; < 0 inside it.
template <class Clearance>
PointFlight fly(Module& module, const Walls& walls, double heading_rad, const Goal& goal, Eigen::Vector2d p,
                double duration_s, Clearance clearance) {
  constexpr double kPeriodS = 0.1, kLagS = 0.4;
  const Setup setup = four_cameras(kSizePx, 1.0 / kPeriodS);
  module.reset(setup);
  PointFlight flight;
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  for (int i = 0; i * kPeriodS < duration_s; ++i) {
    const int64_t t_ns = int64_t{100'000'000} * i;
    const NavigationState navigation = level_flight({p.x(), p.y(), -1.0}, heading_rad, v);
    const auto frames = see(setup, navigation, t_ns, walls, wavy_texture());
    const auto command = std::get<VelocityCommand>(module.update({t_ns, frames, navigation, goal}).command);
    p += v * kPeriodS;
    v += (command.v_WB_W - v) * (kPeriodS / kLagS);
    flight.path.push_back(p);
    flight.least_clearance_m = std::min(flight.least_clearance_m, clearance(p));
  }
  flight.metrics = module.metrics();
  return flight;
}

}  // namespace hedgehop::avoidance::flow_balance
