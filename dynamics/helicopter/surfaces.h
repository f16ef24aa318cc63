#pragma once

#include <Eigen/Core>

#include "sim/fields/field.h"

/// Aerodynamic loads on fuselage, vertical fin and horizontal stabilizer.
namespace hedgehop::dynamics::helicopter {

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct SurfacesConfig {
  Eigen::Vector3d fuselage_drag_areas_m2{0.1, 0.22, 0.15};
  double fin_area_m2 = 0.012;
  double fin_lift_slope_prad = 2.0;
  double stabilizer_area_m2 = 0.01;
  double stabilizer_lift_slope_prad = 3.0;
  double stabilizer_arm_m = 0.71;
  double stabilizer_wake = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SurfacesConfig> auto& c) {
  v("fuselage_drag_areas", c.fuselage_drag_areas_m2,
    {.unit = "m2", .at_least = 0.0, .meaning = "drag areas of the fuselage: forward, sideways, vertical"});
  v("fin_area", c.fin_area_m2,
    {.unit = "m2", .at_least = 0.0, .meaning = "area of the vertical fin at the tail rotor"});
  v("fin_lift_slope", c.fin_lift_slope_prad,
    {.unit = "1/rad", .at_least = 0.0, .meaning = "lift per angle of the fin"});
  v("stabilizer_area", c.stabilizer_area_m2,
    {.unit = "m2", .at_least = 0.0, .meaning = "area of the horizontal stabilizer"});
  v("stabilizer_lift_slope", c.stabilizer_lift_slope_prad,
    {.unit = "1/rad", .at_least = 0.0, .meaning = "lift per angle of the horizontal stabilizer"});
  v("stabilizer_arm", c.stabilizer_arm_m,
    {.unit = "m", .meaning = "distance of the stabilizer behind the mass center"});
  v("stabilizer_wake", c.stabilizer_wake,
    {.at_least = 0.0, .at_most = 2.0, .meaning = "share of the main rotor's induced velocity at the stabilizer"});
}

/// Force and torque about the mass center, in B, N and N m.
struct Loads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();
};

/// @param v_air_B  velocity of B relative to the air, in B, m/s. Source: [HeffleyMnich1988] sec. on the fuselage.
/// Differs: no rotor wake on the fuselage; the force acts at the mass center.
Loads fuselage_loads(const SurfacesConfig& surfaces, double density_kgpm3, const Eigen::Vector3d& v_air_B);

/// @param tail_arm_m, tail_height_m  position of the tail rotor hub and the fin. @param w_WB_B  rad/s.
/// Source: [Gavrilets2015] sec. on the vertical fin. Differs: no tail-rotor wake on the fin.
Loads fin_loads(const SurfacesConfig& surfaces, double density_kgpm3, double tail_arm_m, double tail_height_m,
                const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B);

/// @param induced_mps  of the main rotor. Source: [Gavrilets2015] sec. on the horizontal tail.
Loads stabilizer_loads(const SurfacesConfig& surfaces, double density_kgpm3, double induced_mps,
                       const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B);

}  // namespace hedgehop::dynamics::helicopter
