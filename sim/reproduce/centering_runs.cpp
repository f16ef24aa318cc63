#include "sim/reproduce/calculations.h"

#include <algorithm>
#include <cmath>

#include "avoidance/corridor_centering/centering_law.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr double kHalfWidthM = 2.0, kStartM = -1.5, kSpeedMps = 0.42;
constexpr double kSampleS = 0.5, kDurationS = 120.0, kSettledM = 0.2;
constexpr double kGravityMps2 = 9.80665;

/// Roll and turn rate as the controller commands, speed along the heading held, no drag.
struct PointMass {
  double x_m = 0.0, off_middle_m = kStartM, sideways_mps = 0.0, heading_rad = 0.0;

  void fly(double roll_and_turn) {
    constexpr int kSteps = 100;
    constexpr double dt_s = kSampleS / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      sideways_mps += kGravityMps2 * std::tan(roll_and_turn) * dt_s;
      heading_rad += roll_and_turn * dt_s;
      x_m += (kSpeedMps * std::cos(heading_rad) - sideways_mps * std::sin(heading_rad)) * dt_s;
      off_middle_m += (kSpeedMps * std::sin(heading_rad) + sideways_mps * std::cos(heading_rad)) * dt_s;
    }
  }
};

template <class Noise>
Columns run(Noise noise) {
  PointMass mass;
  Columns columns;
  const auto seen = [&] { return -mass.off_middle_m / kHalfWidthM + noise(); };
  double last = seen(), settled_m = 0.0;
  for (double t_s = 0.0; t_s < kDurationS; t_s += kSampleS) {
    columns["x_m"].push_back(mass.x_m);
    columns["off_middle_m"].push_back(mass.off_middle_m);
    if (std::abs(mass.off_middle_m) > kSettledM) settled_m = mass.x_m;
    const double error = seen();
    mass.fly(avoidance::corridor_centering::published_control({}, error, last));
    last = error;
  }
  columns["settled_m"].assign(columns["x_m"].size(), settled_m);
  return columns;
}

}  // namespace

Columns centering_exact() {
  return run([] { return 0.0; });
}

Columns centering_noisy() {
  // The mean distance of a normal distribution from its middle is 0.798 of its spread.
  constexpr double kMean = 0.146, kMaxErrorRad = 0.54, kSpread = kMean / 0.7979;
  RandomStream random(1);
  return run([&] { return std::clamp(kSpread * random.normal(), -kMaxErrorRad, kMaxErrorRad); });
}

}  // namespace hedgehop::sim
