#include "dynamics/helicopter/main_rotor.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace hedgehop::dynamics::helicopter {
namespace {

/// Returns the lag of a flapping mass, s. Source: [Gavrilets2015] sec. on flapping.
double flapping_lag_s(double lock_number, double speed_radps) { return 16.0 / (lock_number * speed_radps); }

void set_flybar(FlappingModel& model, const LumpedBarConfig& bar, double speed_radps, double /*density*/) {
  model.explicit_bar = false;
  model.lag_s = flapping_lag_s(bar.lock_number, speed_radps);
  model.lateral_gain = bar.lateral_gain;
  model.longitudinal_gain = bar.longitudinal_gain;
}

void set_flybar(FlappingModel& model, const ExplicitBarConfig& bar, double speed_radps, double density_kgpm3) {
  if (!(bar.paddle_inner_radius_m < bar.paddle_outer_radius_m)) {
    throw std::invalid_argument("flybar.paddle_inner_radius must be below paddle_outer_radius, got " +
                                std::to_string(bar.paddle_inner_radius_m) + " and " +
                                std::to_string(bar.paddle_outer_radius_m) + " m");
  }
  const double lock_number = density_kgpm3 * bar.paddle_lift_slope_prad * bar.paddle_chord_m *
                             (std::pow(bar.paddle_outer_radius_m, 4) - std::pow(bar.paddle_inner_radius_m, 4)) /
                             bar.bar_inertia_kgm2;
  model.explicit_bar = true;
  model.lag_s = model.blade_lag_s;
  model.lateral_gain = bar.lateral_gain;
  model.longitudinal_gain = bar.longitudinal_gain;
  model.bar_lag_s = flapping_lag_s(lock_number, speed_radps);
  model.mixing = bar.mixing;
  model.bar_lateral_gain = bar.bar_lateral_gain;
  model.bar_longitudinal_gain = bar.bar_longitudinal_gain;
  if (!(model.lateral_gain + model.mixing * model.bar_lateral_gain > 0.0) ||
      !(model.longitudinal_gain + model.mixing * model.bar_longitudinal_gain > 0.0)) {
    throw std::invalid_argument("flybar: a gain of blades or bar must be above 0, so that the cyclic acts on the disc");
  }
}

FlappingModel make_flapping(const MainRotorConfig& c, double density_kgpm3) {
  FlappingModel m;
  const double R = c.radius_m;
  m.clockwise = c.turns == MainRotorConfig::Turns::clockwise ? 1.0 : -1.0;
  m.lock_number = density_kgpm3 * c.lift_slope_prad * c.chord_m * std::pow(R, 4) / c.blade_inertia_kgm2;
  const double hinge = 1.0 - 8.0 * c.hinge_offset_m / (3.0 * R);
  if (!(hinge > 0.0)) {
    throw std::invalid_argument("main_rotor.hinge_offset must be below 3/8 of the radius, got " +
                                std::to_string(c.hinge_offset_m) + " of " + std::to_string(R) + " m");
  }
  m.blade_lag_s = flapping_lag_s(m.lock_number, c.speed_radps) / hinge;
  m.cross_coupling =
      8.0 * c.hub_stiffness_nmprad / (m.lock_number * c.speed_radps * c.speed_radps * c.blade_inertia_kgm2);
  m.speed_gain = c.speed_flapping;
  const double solidity = static_cast<double>(c.blades) * c.chord_m / (std::numbers::pi * R);
  m.lift_solidity_prad = c.lift_slope_prad * solidity;
  std::visit([&](const auto& bar) { set_flybar(m, bar, c.speed_radps, density_kgpm3); }, c.flybar);
  return m;
}

}  // namespace

MainRotor make_main_rotor(const MainRotorConfig& c, double density_kgpm3) {
  MainRotor rotor;
  rotor.disc = make_rotor_disc(c, c.speed_radps, density_kgpm3);
  rotor.flapping = make_flapping(c, density_kgpm3);
  rotor.speed_radps = c.speed_radps;
  rotor.hub_height_m = c.hub_height_m;
  rotor.hub_stiffness_nmprad = c.hub_stiffness_nmprad;
  return rotor;
}

MainRotorLoads main_rotor_loads(const MainRotor& rotor, const FlapState& flap, const BladeAngles& blades,
                                const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B) {
  const double h = rotor.hub_height_m;
  const double a = flap.back_rad, b = flap.right_rad;
  const double s_R = rotor.flapping.clockwise;

  // Air at the hub, and through the disc.
  const double u_h = v_air_B.x() - w_WB_B.y() * h;
  const double v_h = v_air_B.y() + w_WB_B.x() * h;
  const double w_h = v_air_B.z();
  const double upflow = w_h + a * u_h - b * v_h;
  const double inplane = Eigen::Vector2d(u_h, v_h).norm();

  MainRotorLoads loads;
  loads.inflow = solve_inflow(rotor.disc, blades.collective_rad, upflow, inplane);
  loads.power_w = shaft_power_w(rotor.disc, loads.inflow, upflow, inplane);

  // The thrust is normal to the disc; hub spring and torque act on the body.
  const double T = loads.inflow.thrust_n;
  loads.f_B = {-T * std::sin(a), T * std::sin(b), -T * std::cos(a) * std::cos(b)};
  loads.t_B = {loads.f_B.y() * h + rotor.hub_stiffness_nmprad * b, -loads.f_B.x() * h + rotor.hub_stiffness_nmprad * a,
               -s_R * loads.power_w / rotor.speed_radps};

  const double tip = rotor.disc.tip_speed_mps;
  loads.flap_input = {.lateral_rad = blades.lateral_rad,
                      .longitudinal_rad = blades.longitudinal_rad,
                      .collective_rad = blades.collective_rad,
                      .inflow_ratio = loads.inflow.induced_mps / tip,
                      .forward_ratio = u_h / tip,
                      .right_ratio = v_h / tip,
                      .down_ratio = w_h / tip,
                      .roll_radps = w_WB_B.x(),
                      .pitch_radps = w_WB_B.y()};
  return loads;
}

}  // namespace hedgehop::dynamics::helicopter
