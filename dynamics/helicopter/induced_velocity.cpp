#include "dynamics/helicopter/induced_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kFreeAdvanceRatio = 0.1;  // above it, forward flight carries the wake away
constexpr double kLimitGrowth = 10.0;      // growth of the limit of w_r with V beyond that, m/s per m/s
constexpr double kTolerance = 1e-7;        // of a step, relative to the bracket; the error is its square
constexpr int kMaxIterations = 60;         // enough for bisection alone

/// Thrusts of both theories at one v_i, for a rotor with upward thrust (w_r + 2/3 Omega R theta > 0).
struct Balance {
  double residual, newton_step, thrust;
  bool within_momentum_theory;
};
Balance balance(const RotorDisc& disc, double blade_mps, double upflow, double inplane, double v_i) {
  Balance b;
  const double blade_thrust = disc.lift_nspm * (blade_mps - v_i);
  b.thrust = std::min(blade_thrust, disc.max_thrust_n);

  // Outside the range of momentum theory, its upflow stays at the limit.
  const double flow_per_thrust = 2.0 * disc.density_kgpm3 * disc.area_m2;
  const double hover_inflow2 = std::max(0.0, b.thrust) / flow_per_thrust;
  const double free = kLimitGrowth * std::max(0.0, inplane - kFreeAdvanceRatio * disc.tip_speed_mps);
  const double beyond_free = upflow - free;
  b.within_momentum_theory =
      beyond_free <= 0.0 || beyond_free * beyond_free <= disc.descent_limit * disc.descent_limit * hover_inflow2;
  const double w = b.within_momentum_theory ? upflow : disc.descent_limit * std::sqrt(hover_inflow2) + free;

  const double resultant2 = inplane * inplane + (w - v_i) * (w - v_i), resultant = std::sqrt(resultant2);
  const double momentum = flow_per_thrust * disc.efficiency;
  b.residual = momentum * v_i * resultant - b.thrust;
  // Divided by the resultant, which is 0 only without flow in the plane; the momentum's slope is then 0, too.
  const double blade_slope = blade_thrust < disc.max_thrust_n ? disc.lift_nspm : 0.0;
  const double slope = momentum * (resultant2 + v_i * (v_i - w)) + blade_slope * resultant;
  b.newton_step = resultant > 0.0 ? b.residual * resultant / slope : b.residual / blade_slope;
  return b;
}

}  // namespace

RotorDisc make_rotor_disc(const RotorGeometry& rotor, double speed_radps, double density_kgpm3) {
  const double rho = density_kgpm3;
  const double R = rotor.radius_m;
  const double omega_R = speed_radps * R;
  const double blade_area = static_cast<double>(rotor.blades) * rotor.chord_m * R;
  RotorDisc disc;
  disc.density_kgpm3 = rho;
  disc.area_m2 = std::numbers::pi * R * R;
  disc.tip_speed_mps = omega_R;
  disc.lift_nspm = rho * omega_R * blade_area * rotor.lift_slope_prad / 4.0;
  disc.efficiency = rotor.efficiency;
  disc.max_thrust_n = rotor.max_thrust_coefficient * rho * disc.area_m2 * omega_R * omega_R;
  disc.profile_power_w = rho * blade_area * rotor.profile_drag * omega_R * omega_R * omega_R / 8.0;
  disc.profile_power_growth = rotor.profile_power_growth;
  return disc;
}

RotorDisc at_speed(RotorDisc disc, double ratio) {
  disc.tip_speed_mps *= ratio;
  disc.lift_nspm *= ratio;
  disc.max_thrust_n *= ratio * ratio;
  disc.profile_power_w *= ratio * ratio * ratio;
  return disc;
}

Inflow solve_inflow(const RotorDisc& disc, double collective_rad, double upflow_mps, double inplane_mps) {
  // Downward thrust is solved as upward thrust of the inverted rotor.
  const double signed_blade_mps = upflow_mps + 2.0 / 3.0 * disc.tip_speed_mps * collective_rad;
  const double sign = signed_blade_mps < 0.0 ? -1.0 : 1.0;
  const double blade_mps = sign * signed_blade_mps;
  const double upflow = sign * upflow_mps;

  // v_i is between 0 and the flow through the blades. The initial guess is that of a hover.
  double low = 0.0, high = blade_mps;
  const double half = disc.lift_nspm / (4.0 * disc.density_kgpm3 * disc.area_m2 * disc.efficiency);
  double v_i = 2.0 * half * blade_mps / (half + std::sqrt(half * half + 2.0 * half * blade_mps) + 1e-300);
  v_i = std::min(v_i, blade_mps);
  Balance b = balance(disc, blade_mps, upflow, inplane_mps, v_i);
  for (int i = 0; i < kMaxIterations; ++i) {
    (b.residual > 0.0 ? high : low) = v_i;
    const bool last = std::abs(b.newton_step) <= kTolerance * blade_mps;
    v_i -= b.newton_step;
    if (!last && !(v_i > low && v_i < high)) v_i = 0.5 * (low + high);
    b = balance(disc, blade_mps, upflow, inplane_mps, v_i);
    if (last) break;
  }
  return {sign * b.thrust, sign * v_i, b.within_momentum_theory};
}

double shaft_power_w(const RotorDisc& disc, const Inflow& inflow, double upflow_mps, double inplane_mps) {
  const double mu = inplane_mps / disc.tip_speed_mps;
  return inflow.thrust_n * (inflow.induced_mps - upflow_mps) +
         disc.profile_power_w * (1.0 + disc.profile_power_growth * mu * mu);
}

}  // namespace hedgehop::dynamics::helicopter
