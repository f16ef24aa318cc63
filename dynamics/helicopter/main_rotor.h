#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "dynamics/helicopter/blade_servos.h"
#include "dynamics/helicopter/flapping.h"
#include "dynamics/helicopter/induced_velocity.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::helicopter {

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct MainRotorConfig : RotorGeometry {
  enum class Turns { counter_clockwise, clockwise };
  Turns turns = Turns::clockwise;
  double speed_radps = 167.0;
  double blade_inertia_kgm2 = 0.038;
  double hinge_offset_m = 0.0;
  double hub_stiffness_nmprad = 54.0;
  double hub_height_m = 0.235;
  double speed_flapping = 0.2;
  FlybarConfig flybar;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MainRotorConfig> auto& c) {
  v("turns", c.turns, {.choices = {"counter_clockwise", "clockwise"}, .meaning = "sense of rotation seen from above"});
  v("speed", c.speed_radps, {.unit = "rad/s", .above = 0.0, .meaning = "rotor speed set by the governor"});
  describe(v, fields::base<RotorGeometry>(c));
  v("blade_inertia", c.blade_inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "flapping moment of inertia of one blade"});
  v("hinge_offset", c.hinge_offset_m,
    {.unit = "m", .at_least = 0.0, .meaning = "distance of the flapping hinge from the shaft"});
  v("hub_stiffness", c.hub_stiffness_nmprad,
    {.unit = "N m/rad", .at_least = 0.0, .meaning = "hub torque per disc tilt"});
  v("hub_height", c.hub_height_m, {.unit = "m", .above = 0.0, .meaning = "height of the hub above the mass center"});
  v("speed_flapping", c.speed_flapping,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "K_mu: share of the ideal flap-back with speed"});
  v("flybar", c.flybar, {.meaning = "stabilizer bar"});
}

/// Derived parameters of a main rotor at constant speed.
struct MainRotor {
  RotorDisc disc;
  FlappingModel flapping;
  double speed_radps = 0.0;
  double hub_height_m = 0.0;
  double hub_stiffness_nmprad = 0.0;
};
/// Throws std::invalid_argument if the geometry is invalid.
MainRotor make_main_rotor(const MainRotorConfig& config, double density_kgpm3);

/// Force and torque of the main rotor about the mass center, in B.
struct MainRotorLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< about the mass center, N m
  Inflow inflow;
  double power_w = 0.0;  ///< at the shaft
  FlapInput flap_input;  ///< inputs of the flapping equations at this instant
};

/// @param v_air_B  velocity of B relative to the air, in B, m/s. @param w_WB_B  rad/s.
/// Source: [HeffleyMnich1988] sec. on the main rotor; [Gavrilets2015] sec. on rotor forces.
MainRotorLoads main_rotor_loads(const MainRotor& rotor, const FlapState& flap, const BladeAngles& blades,
                                const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B);

}  // namespace hedgehop::dynamics::helicopter
