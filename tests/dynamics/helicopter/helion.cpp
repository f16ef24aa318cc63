#include "tests/dynamics/helicopter/helion.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kMassKg = 9.75;

/// Lift at small angles, cross-flow drag at larger ones.
double surface_force_n(double half_density, double area_m2, double lift_slope_prad, double along, double across) {
  constexpr double kStall = 0.3;
  const bool flies = std::abs(across) <= kStall * std::abs(along);
  return -half_density * area_m2 * across * (flies ? lift_slope_prad * std::abs(along) : std::abs(across));
}

}  // namespace

MainRotorConfig helion_main_rotor() {
  MainRotorConfig c;
  c.speed_radps = 193.73;
  c.radius_m = 0.705;
  c.chord_m = 0.062;
  c.lift_slope_prad = 5.5218;
  c.profile_drag = 0.01;
  c.max_thrust_coefficient = 1.0;  // the model has no stall
  c.blade_inertia_kgm2 = 0.055;
  c.hinge_offset_m = 0.07;
  c.hub_stiffness_nmprad = 113.7942;
  c.hub_height_m = 0.337;
  c.speed_flapping = 0.0;
  c.flybar = ExplicitBarConfig{.mixing = 1.0,
                               .lateral_gain = 0.20,
                               .longitudinal_gain = 0.21,
                               .bar_lateral_gain = 0.57,
                               .bar_longitudinal_gain = 0.56,
                               .paddle_inner_radius_m = 0.231,
                               .paddle_outer_radius_m = 0.312,
                               .paddle_chord_m = 0.059,
                               .paddle_lift_slope_prad = 2.718,
                               .bar_inertia_kgm2 = 0.004};
  return c;
}

TailRotorConfig helion_tail_rotor() {
  TailRotorConfig c;
  c.gear_ratio = 4.65;
  c.radius_m = 0.128;
  c.chord_m = 0.029;
  c.lift_slope_prad = 2.8214;
  c.max_thrust_coefficient = 1.0;
  c.arm_m = 1.035;
  c.height_m = 0.172;
  return c;
}

HelionModel make_helion() {
  HelionModel m;
  m.density_kgpm3 = 1.292;
  m.gravity_mps2 = 9.781;
  m.mass = make_mass_properties(kMassKg, {0.2509, 0.5483, 0.787}, 0.0);
  m.main_rotor = make_main_rotor(helion_main_rotor(), m.density_kgpm3);
  m.tail_rotor =
      make_tail_rotor(helion_tail_rotor(), m.main_rotor.speed_radps, m.main_rotor.flapping.clockwise, m.density_kgpm3);

  // Bar lumped into the rotor: sums of lags and gains. Cross terms as published, times the blades' lag.
  FlappingModel& f = m.main_rotor.flapping;
  f.longitudinal_gain += f.mixing * f.bar_longitudinal_gain;
  f.lateral_gain += f.mixing * f.bar_lateral_gain;
  f.cross_coupling *= f.blade_lag_s;
  f.lag_s = f.blade_lag_s + f.mixing * f.bar_lag_s;
  f.mixing = f.bar_longitudinal_gain = f.bar_lateral_gain = 0.0;

  m.fuselage_drag_areas_m2 = {0.1026, 0.9, 0.084};
  m.stabilizer_area_m2 = 0.011;
  m.fin_area_m2 = 0.0072;
  m.surface_lift_slope_prad = 2.865;
  m.stabilizer_arm_m = 0.751;
  m.fin_arm_m = 0.984;
  m.fin_height_m = 0.184;
  return m;
}

HelicopterLoads helicopter_loads(const HelionModel& m, const HelicopterState& state, const BladeAngles& blades,
                                 const Eigen::Vector3d& wind_W) {
  const Eigen::Matrix3d R_WB = state.body.q_WB.normalized().toRotationMatrix();
  const Eigen::Vector3d v_air_B = state.body.v_WB_B - R_WB.transpose() * wind_W;
  const Eigen::Vector3d& w_B = state.body.w_WB_B;
  const double half_density = 0.5 * m.density_kgpm3;

  HelicopterLoads loads;
  loads.main_rotor = main_rotor_loads(m.main_rotor, state.flap, blades, v_air_B, Eigen::Vector3d::Zero());
  loads.main_rotor.flap_input.roll_radps = w_B.x();
  loads.main_rotor.flap_input.pitch_radps = w_B.y();
  loads.tail_rotor = tail_rotor_loads(m.tail_rotor, blades.tail_rad, v_air_B, w_B);

  // Fuselage in the wake.
  const double v_i = loads.main_rotor.inflow.induced_mps;
  const Eigen::Vector3d in_wake = v_air_B - Eigen::Vector3d(0.0, 0.0, v_i);
  const Eigen::Vector3d speed{std::max(std::abs(v_air_B.x()), v_i), std::max(std::abs(v_air_B.y()), v_i),
                              std::abs(in_wake.z())};
  const Eigen::Vector3d fuselage = -half_density * m.fuselage_drag_areas_m2.cwiseProduct(speed).cwiseProduct(in_wake);

  // Stabilizer in the wake, fin.
  const double slope = m.surface_lift_slope_prad;
  const double w_hf = in_wake.z() + w_B.y() * m.stabilizer_arm_m;
  const double v_vf = v_air_B.y() - w_B.z() * m.fin_arm_m + w_B.x() * m.fin_height_m;
  const double Z_hf = surface_force_n(half_density, m.stabilizer_area_m2, slope, v_air_B.x(), w_hf);
  const double Y_vf = surface_force_n(half_density, m.fin_area_m2, slope, v_air_B.x(), v_vf);

  // The shaft power includes climb and drag.
  const double T = loads.main_rotor.inflow.thrust_n;
  const double mu = std::hypot(v_air_B.x(), v_air_B.y()) / m.main_rotor.disc.tip_speed_mps;
  loads.main_rotor.power_w =
      m.main_rotor.disc.profile_power_w * (1.0 + m.main_rotor.disc.profile_power_growth * mu * mu) + T * v_i +
      m.mass.mass_kg * m.gravity_mps2 * std::abs(std::min(v_air_B.z(), 0.0)) - fuselage.dot(in_wake);
  loads.main_rotor.t_B.z() = -m.main_rotor.flapping.clockwise * loads.main_rotor.power_w / m.main_rotor.speed_radps;

  const double heavier_n = m.mass.mass_kg * (m.gravity_mps2 - kGravityMps2);
  loads.f_B = loads.main_rotor.f_B + loads.tail_rotor.f_B + fuselage + Eigen::Vector3d(0.0, Y_vf, Z_hf) +
              heavier_n * R_WB.row(2).transpose();
  loads.t_B = loads.main_rotor.t_B + loads.tail_rotor.t_B +
              Eigen::Vector3d(Y_vf * m.fin_height_m, Z_hf * m.stabilizer_arm_m, -Y_vf * m.fin_arm_m);
  return loads;
}

std::optional<Trim> trim(const HelionModel& model, const Eigen::Vector3d& v_air_W, double heading_rad) {
  return trim(airframe(model), v_air_W, heading_rad);
}
LinearModel linearize(const HelionModel& model, const Trim& trim) { return linearize(airframe(model), trim); }

}  // namespace hedgehop::dynamics::helicopter
