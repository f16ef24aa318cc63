#include "dynamics/helicopter/helicopter.h"

#include <algorithm>
#include <cmath>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::helicopter {

HelicopterVector to_vector(const HelicopterState& state) {
  HelicopterVector x;
  const FlapState& flap = state.flap;
  x << to_vector(state.body), flap.back_rad, flap.right_rad, flap.bar_back_rad, flap.bar_right_rad;
  return x;
}

HelicopterState to_helicopter(const HelicopterVector& x) {
  return {to_rigid_body(x.head<13>()), {x[13], x[14], x[15], x[16]}};
}

HelicopterModel make_model(const HelicopterConfig& config) {
  const double density = config.air_density_kgpm3;
  fields::require_bounds(config);
  HelicopterModel model;
  model.mass = make_mass_properties(config.mass.mass_kg, config.mass.inertia_kgm2, config.mass.inertia_xz_kgm2);
  model.main_rotor = make_main_rotor(config.main_rotor, density);
  model.tail_rotor =
      make_tail_rotor(config.tail_rotor, config.main_rotor.speed_radps, model.main_rotor.flapping.clockwise, density);
  model.surfaces = config.surfaces;
  model.density_kgpm3 = density;
  return model;
}

HelicopterModel at_speed(HelicopterModel model, double main_radps) {
  const double ratio = std::max(main_radps / model.main_rotor.speed_radps, kSlowestRotor);
  model.main_rotor.disc = at_speed(model.main_rotor.disc, ratio);
  model.main_rotor.flapping = at_speed(model.main_rotor.flapping, ratio);
  model.main_rotor.speed_radps *= ratio;
  model.tail_rotor.disc = at_speed(model.tail_rotor.disc, ratio);
  return model;
}

HelicopterLoads helicopter_loads(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                                 const Eigen::Vector3d& wind_W) {
  const Eigen::Matrix3d R_WB = state.body.q_WB.normalized().toRotationMatrix();
  const Eigen::Vector3d v_air_B = state.body.v_WB_B - R_WB.transpose() * wind_W;
  const Eigen::Vector3d& w_B = state.body.w_WB_B;
  const double rho = model.density_kgpm3;

  HelicopterLoads loads;
  loads.main_rotor = main_rotor_loads(model.main_rotor, state.flap, blades, v_air_B, w_B);
  loads.tail_rotor = tail_rotor_loads(model.tail_rotor, blades.tail_rad, v_air_B, w_B);
  const Loads fuselage = fuselage_loads(model.surfaces, rho, v_air_B);
  const Loads fin = fin_loads(model.surfaces, rho, model.tail_rotor.arm_m, model.tail_rotor.height_m, v_air_B, w_B);
  const Loads stabilizer = stabilizer_loads(model.surfaces, rho, loads.main_rotor.inflow.induced_mps, v_air_B, w_B);
  loads.f_B = loads.main_rotor.f_B + loads.tail_rotor.f_B + fuselage.f_B + fin.f_B + stabilizer.f_B;
  loads.t_B = loads.main_rotor.t_B + loads.tail_rotor.t_B + fuselage.t_B + fin.t_B + stabilizer.t_B;
  return loads;
}

HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const HelicopterLoads& loads) {
  HelicopterVector rate;
  rate << derivative(model.mass, state.body, loads.f_B, loads.t_B),
      derivative(model.main_rotor.flapping, state.flap, loads.main_rotor.flap_input);
  return rate;
}

HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                            const Eigen::Vector3d& wind_W) {
  return derivative(model, state, helicopter_loads(model, state, blades, wind_W));
}

}  // namespace hedgehop::dynamics::helicopter
