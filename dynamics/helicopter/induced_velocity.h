#pragma once

#include <cstdint>

#include "sim/fields/field.h"

/// Thrust and induced velocity of one rotor, from blade element and momentum theory.
namespace hedgehop::dynamics::helicopter {

/// One rotor as a lifting disc at constant rotor speed.
struct RotorDisc {
  double density_kgpm3 = 1.225;
  double area_m2 = 1.0;
  double tip_speed_mps = 1.0;
  double lift_nspm = 1.0;             ///< K: thrust per m/s of flow through the blades, rho Omega R^2 a n c / 4
  double efficiency = 1.0;            ///< eta_w of the momentum balance; 1 is ideal
  double max_thrust_n = 1e9;          ///< at blade stall
  double descent_limit = 0.5;         ///< maximum w_r over hover inflow for momentum theory, < 1.7
  double profile_power_w = 0.0;       ///< P0 in hover
  double profile_power_growth = 0.0;  ///< kappa: P = P0 (1 + kappa mu^2)
};

/// Geometry and airfoil of a rotor.
struct RotorGeometry {
  double radius_m = 0.775;
  double chord_m = 0.058;
  int64_t blades = 2;
  double lift_slope_prad = 5.5;
  double profile_drag = 0.024;
  double profile_power_growth = 4.6;
  double max_thrust_coefficient = 0.0055;
  double efficiency = 1.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RotorGeometry> auto& c) {
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "blade tip radius"});
  v("chord", c.chord_m, {.unit = "m", .above = 0.0, .meaning = "blade chord"});
  v("blades", c.blades, {.at_least = 2.0, .at_most = 8.0, .meaning = "number of blades"});
  v("lift_slope", c.lift_slope_prad, {.unit = "1/rad", .above = 0.0, .meaning = "lift per angle of a blade section"});
  v("profile_drag", c.profile_drag, {.at_least = 0.0, .meaning = "mean drag coefficient of a blade section"});
  v("profile_power_growth", c.profile_power_growth,
    {.at_least = 0.0, .meaning = "kappa of the profile power P0 (1 + kappa mu^2)"});
  v("max_thrust_coefficient", c.max_thrust_coefficient, {.above = 0.0, .meaning = "C_T at which the blades stall"});
  v("efficiency", c.efficiency,
    {.above = 0.0, .at_most = 1.0, .meaning = "efficiency of the momentum balance, 1 is ideal"});
}
/// Returns the disc of a rotor. @param speed_radps  rotor speed, > 0. @param density_kgpm3  of the air, > 0.
RotorDisc make_rotor_disc(const RotorGeometry& rotor, double speed_radps, double density_kgpm3);
/// Returns the same rotor at `ratio` times its speed.
RotorDisc at_speed(RotorDisc disc, double ratio);

struct Inflow {
  double thrust_n = 0.0;     ///< along the shaft
  double induced_mps = 0.0;  ///< v_i, opposite to the thrust; it has the sign of the thrust
  /// True if the descent is slower than the disc's limit, or fast forward flight carries the wake away.
  bool within_momentum_theory = true;
};

/// Returns the thrust for which blade element theory and momentum theory agree:
///   T = K (w_r + 2/3 Omega R theta - v_i),   T = 2 rho A eta v_i sqrt(V^2 + (w_r - v_i)^2).
/// @param collective_rad  theta, blade angle at 3/4 radius.
/// @param upflow_mps      w_r, air through the disc along the thrust; negative in climb.
/// @param inplane_mps     V, air speed along the disc, >= 0.
/// Below advance ratio 0.1, the momentum balance limits w_r to `descent_limit` times the hover inflow of the thrust,
/// because momentum theory is not valid beyond it; the result then reports so. The thrust is limited by blade stall.
/// Finite for all finite arguments. Source: [HeffleyMnich1988] sec. on thrust and induced velocity. Differs: solved by
/// a bracketed Newton iteration instead of a fixed number of passes. Above advance ratio 0.1, the limit on w_r rises
/// steeply instead of vanishing, so that the thrust has no jump.
Inflow solve_inflow(const RotorDisc& disc, double collective_rad, double upflow_mps, double inplane_mps);

/// Returns the shaft power T (v_i - w_r) + P0 (1 + kappa mu^2), W. Source: [HeffleyMnich1988] sec. on the main rotor.
double shaft_power_w(const RotorDisc& disc, const Inflow& inflow, double upflow_mps, double inplane_mps);

}  // namespace hedgehop::dynamics::helicopter
