#pragma once

#include <Eigen/Core>
#include <optional>

#include "dynamics/helicopter/trim.h"

/// HeLion as published. It serves to compare the parts that it shares with other helicopters with published trims and
/// modes; scenarios do not use it. Source: [HeLionCode] sec. on the 15-state model.
/// Its rotors, disc and rigid body are those of HelicopterModel. Differences: main rotor and fuselage are in the rotor
/// wake, rotation does not change the air at the main rotor hub, the fin is not at the tail rotor, and the shaft power
/// includes that of the fuselage drag.
namespace hedgehop::dynamics::helicopter {

struct HelionModel {
  MassProperties mass;
  MainRotor main_rotor;  ///< its lumped bar: a rotor with the lag of both, and a bar without effect
  TailRotor tail_rotor;
  Eigen::Vector3d fuselage_drag_areas_m2;
  double stabilizer_area_m2, fin_area_m2, surface_lift_slope_prad;
  double stabilizer_arm_m, fin_arm_m, fin_height_m;
  double density_kgpm3, gravity_mps2;
};

/// Rotor and tail rotor of HeLion; the cyclic is in units of stick. Source: [HeLionCode] sec. on constants.
MainRotorConfig helion_main_rotor();
TailRotorConfig helion_tail_rotor();
HelionModel make_helion();

// As for a HelicopterModel. The loads include the difference of HeLion's gravity from kGravityMps2.
HelicopterLoads helicopter_loads(const HelionModel& model, const HelicopterState& state, const BladeAngles& blades,
                                 const Eigen::Vector3d& wind_W);
std::optional<Trim> trim(const HelionModel& model, const Eigen::Vector3d& v_air_W, double heading_rad = 0.0);
LinearModel linearize(const HelionModel& model, const Trim& trim);

}  // namespace hedgehop::dynamics::helicopter
