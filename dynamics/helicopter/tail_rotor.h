#pragma once

#include <Eigen/Core>

#include "dynamics/helicopter/induced_velocity.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::helicopter {

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct TailRotorConfig : RotorGeometry {
  TailRotorConfig()
      : RotorGeometry{.radius_m = 0.13, .chord_m = 0.029, .lift_slope_prad = 5.0, .max_thrust_coefficient = 0.05} {}
  double gear_ratio = 4.66;
  double thrust_fraction = 1.0;
  double arm_m = 0.91;
  double height_m = 0.08;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<TailRotorConfig> auto& c) {
  v("gear_ratio", c.gear_ratio, {.above = 0.0, .meaning = "speed ratio of tail rotor to main rotor"});
  describe(v, fields::base<RotorGeometry>(c));
  v("thrust_fraction", c.thrust_fraction,
    {.above = 0.0, .at_most = 1.0, .meaning = "share of the thrust that the fin next to the rotor leaves"});
  v("arm", c.arm_m, {.unit = "m", .above = 0.0, .meaning = "distance of the hub behind the mass center"});
  v("height", c.height_m, {.unit = "m", .meaning = "height of the hub above the mass center"});
}

struct TailRotor {
  RotorDisc disc;
  double clockwise = 1.0;  ///< s_R of the main rotor, whose torque the tail rotor opposes
  double thrust_fraction = 1.0;
  double arm_m = 0.0, height_m = 0.0;
};
/// @param main_speed_radps  of the main rotor. @param clockwise  +1 if the main rotor turns clockwise seen from above.
TailRotor make_tail_rotor(const TailRotorConfig& config, double main_speed_radps, double clockwise,
                          double density_kgpm3);

struct TailRotorLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< about the mass center, N m
  Inflow inflow;
  double power_w = 0.0;
};
/// @param collective_rad  at 3/4 radius. @param v_air_B  velocity of B relative to the air, in B, m/s. @param w_WB_B
/// rad/s. Source: [HeffleyMnich1988] sec. on the tail rotor; [Gavrilets2015] sec. on the tail rotor.
TailRotorLoads tail_rotor_loads(const TailRotor& rotor, double collective_rad, const Eigen::Vector3d& v_air_B,
                                const Eigen::Vector3d& w_WB_B);

}  // namespace hedgehop::dynamics::helicopter
