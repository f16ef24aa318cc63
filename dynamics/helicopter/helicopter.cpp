#include "dynamics/helicopter/helicopter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::helicopter {

std::vector<HullPart> hull(const HelicopterConfig& config) {
  const HelicopterHullConfig& h = config.hull;
  const double R = config.main_rotor.radius_m, R_tr = config.tail_rotor.radius_m;
  const double half_disc = 0.5 * h.disc_thickness_m, half_boom = 0.5 * h.boom_thickness_m;
  const Eigen::Vector3d tail_hub{-config.tail_rotor.arm_m, 0.0, -config.tail_rotor.height_m};

  // The boom extends from the fuselage to the tail rotor, at the height of its hub.
  const double front = h.fuselage_center_B_m.x() - 0.5 * h.fuselage_size_m.x();
  const double half_length = 0.5 * (front - tail_hub.x());
  const std::vector<HullPart> parts = {
      {HullPart::Shape::cylinder, {0.0, 0.0, -config.main_rotor.hub_height_m}, {R, R, half_disc}},
      {HullPart::Shape::box, h.fuselage_center_B_m, 0.5 * h.fuselage_size_m},
      {HullPart::Shape::box, {front - half_length, 0.0, tail_hub.z()}, {half_length, half_boom, half_boom}},
      {HullPart::Shape::box, tail_hub, {R_tr, half_disc, R_tr}}};
  for (const HullPart& part : parts) {
    if (!part.center_B_m.allFinite() || !part.half_extents_m.allFinite() ||
        !(part.half_extents_m.array() > 0.0).all()) {
      throw std::invalid_argument("hull: every part must have a size, and the fuselage must end before the tail rotor");
    }
  }
  return parts;
}

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
  const double ratio = std::max(main_radps / model.main_rotor.speed_radps, kMinRotorSpeed);
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
