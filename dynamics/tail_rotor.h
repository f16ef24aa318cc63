#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "dynamics/induced_velocity.h"

namespace hedgehop::dynamics {

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct TailRotorConfig {
  double gear_ratio = 4.66;
  double radius_m = 0.13;
  double chord_m = 0.029;
  int64_t blades = 2;
  double lift_slope_prad = 5.0;
  double profile_drag = 0.024;
  double profile_power_growth = 4.6;
  double max_thrust_coefficient = 0.05;
  double efficiency = 1.0;
  double thrust_fraction = 1.0;
  double arm_m = 0.91;
  double height_m = 0.08;
};
template <class Visitor>
void describe(Visitor& v, TailRotorConfig& c) {
  v("gear_ratio", c.gear_ratio, {.above = 0.0, .meaning = "turns per turn of the main rotor"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "blade tip radius"});
  v("chord", c.chord_m, {.unit = "m", .above = 0.0, .meaning = "blade chord"});
  v("blades", c.blades, {.at_least = 2.0, .at_most = 8.0, .meaning = "number of blades"});
  v("lift_slope", c.lift_slope_prad, {.unit = "1/rad", .above = 0.0, .meaning = "lift per angle of a blade section"});
  v("profile_drag", c.profile_drag, {.at_least = 0.0, .meaning = "mean drag coefficient of a blade section"});
  v("profile_power_growth", c.profile_power_growth,
    {.at_least = 0.0, .meaning = "kappa of the profile power P0 (1 + kappa mu^2)"});
  v("max_thrust_coefficient", c.max_thrust_coefficient, {.above = 0.0, .meaning = "C_T at which the blades stall"});
  v("efficiency", c.efficiency, {.above = 0.0, .at_most = 1.0, .meaning = "of the momentum balance, 1 is ideal"});
  v("thrust_fraction", c.thrust_fraction,
    {.above = 0.0, .at_most = 1.0, .meaning = "of the thrust that the fin beside the rotor leaves"});
  v("arm", c.arm_m, {.unit = "m", .above = 0.0, .meaning = "of the hub behind the mass centre"});
  v("height", c.height_m, {.unit = "m", .meaning = "of the hub above the mass centre"});
}

struct TailRotor {
  RotorDisc disc;
  double clockwise = 1.0;  ///< s_R of the main rotor, whose torque it opposes
  double thrust_fraction = 1.0;
  double arm_m = 0.0, height_m = 0.0;
};
/// @param main_speed_radps  of the main rotor. @param clockwise  +1 when the main rotor turns clockwise from above.
TailRotor make_tail_rotor(const TailRotorConfig& config, double main_speed_radps, double clockwise,
                          double density_kgpm3);

struct TailRotorLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< about the mass centre, N m
  Inflow inflow;
  double power_w = 0.0;
};
/// @param collective_rad  at 3/4 radius. @param v_air_B  velocity of B through the air, m/s. @param w_WB_B  rad/s.
/// Source: [HeffleyMnich1988] sec. on the tail rotor; [Gavrilets2015] sec. on the tail rotor.
TailRotorLoads tail_rotor_loads(const TailRotor& rotor, double collective_rad, const Eigen::Vector3d& v_air_B,
                                const Eigen::Vector3d& w_WB_B);

}  // namespace hedgehop::dynamics
