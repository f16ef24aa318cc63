#include "dynamics/steady_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <variant>

#include "dynamics/helicopter/trim.h"
#include "dynamics/multicopter/multicopter_trim.h"
#include "sim/fields/quantities.h"

namespace hedgehop::dynamics {
namespace {

/// A blade angle with the stops of its servo.
Quantity blade_angle(const char* name, double angle_rad, const helicopter::ServoConfig& servo, const char* group,
                     const char* meaning) {
  return {name,
          "deg",
          angle_rad * kDegPerRad,
          group,
          meaning,
          servo.lowest_rad * kDegPerRad,
          servo.highest_rad * kDegPerRad};
}

SteadyFlight described(const helicopter::HelicopterConfig& config, const helicopter::HelicopterModel& model,
                       const helicopter::Trim& t) {
  const helicopter::MainRotorLoads& main = t.loads.main_rotor;
  const double tail_w = t.loads.tail_rotor.power_w;
  const auto* engine = std::get_if<helicopter::GovernedEngineConfig>(&config.rotor_speed);
  const auto max_power_w = engine ? std::optional(engine->max_power_w) : std::nullopt;
  const helicopter::ServosConfig& servos = config.servos;
  return {t.roll_rad,
          t.pitch_rad,
          {{"phi", "deg", t.roll_rad * kDegPerRad, "Attitude", "roll"},
           {"theta", "deg", t.pitch_rad * kDegPerRad, "Attitude", "pitch"},
           blade_angle("theta_c", t.blades.collective_rad, servos.collective, "Main collective", "main collective"),
           blade_angle("theta_t", t.blades.tail_rad, servos.tail, "Tail collective", "tail collective"),
           blade_angle("delta_lat", t.blades.lateral_rad, servos.cyclic, "Cyclic", "lateral cyclic"),
           blade_angle("delta_lon", t.blades.longitudinal_rad, servos.cyclic, "Cyclic", "longitudinal cyclic"),
           {"T", "N", main.inflow.thrust_n, "Thrust", "main rotor", {}, model.main_rotor.disc.max_thrust_n},
           {"v_i", "m/s", main.inflow.induced_mps, "Induced velocity", "main rotor"},
           {"P", "W", main.power_w, "Shaft power", "main rotor"},
           {"P_t", "W", tail_w, "Shaft power", "tail rotor"},
           {"P_shaft", "W", main.power_w + tail_w, "Shaft power", "both rotors", {}, max_power_w}}};
}

SteadyFlight described(const multicopter::MulticopterModel& model, const multicopter::MulticopterTrim& t) {
  const Controls controls = multicopter::wrench(model, t.state.speeds_radps);
  const double slowest = t.state.speeds_radps.minCoeff(), fastest = t.state.speeds_radps.maxCoeff();
  return {t.roll_rad,
          t.pitch_rad,
          {{"phi", "deg", t.roll_rad * kDegPerRad, "Attitude", "roll"},
           {"theta", "deg", t.pitch_rad * kDegPerRad, "Attitude", "pitch"},
           {"T", "N", controls[kHeave], "Thrust", "all rotors"},
           {"L", "N m", controls[kRoll], "Torque of the rotors", "roll"},
           {"M", "N m", controls[kPitch], "Torque of the rotors", "pitch"},
           {"N", "N m", controls[kYaw], "Torque of the rotors", "yaw"},
           {"omega_min", "rad/s", slowest, "Rotor speeds", "slowest", 0.0, model.rotor.highest_radps},
           {"omega_max", "rad/s", fastest, "Rotor speeds", "fastest", 0.0, model.rotor.highest_radps}}};
}

std::optional<SteadyFlight> steady(const helicopter::HelicopterConfig& config, const Eigen::Vector3d& v_air_W) {
  const helicopter::HelicopterModel model = make_model(config);
  const std::optional<helicopter::Trim> found = trim(model, v_air_W);
  return found ? std::optional(described(config, model, *found)) : std::nullopt;
}

std::optional<SteadyFlight> steady(const multicopter::MulticopterConfig& config, const Eigen::Vector3d& v_air_W) {
  const multicopter::MulticopterModel model = make_model(config);
  const std::optional<multicopter::MulticopterTrim> found = trim_of_any_speed(model, v_air_W);
  return found ? std::optional(described(model, *found)) : std::nullopt;
}

std::optional<NamedLinearSystem> linear(const helicopter::HelicopterConfig& config, const Eigen::Vector3d& v_air_W) {
  using L = helicopter::LinearModel;
  const helicopter::HelicopterModel model = make_model(config);
  const std::optional<helicopter::Trim> found = trim(model, v_air_W);
  if (!found) return std::nullopt;
  const L linear = linearize(model, *found);
  static constexpr const char* kNames[L::kStates] = {"u",     "v",   "w", "p", "q", "r", "phi",
                                                     "theta", "psi", "a", "b", "c", "d"};
  NamedLinearSystem out{{}, {"theta_c", "delta_lat", "delta_lon", "theta_t"}, {}, {4, "rad"}, {}};
  std::vector<int> used;  // a lumped stabilizer bar has no states of its own
  for (int i = 0; i < L::kStates; ++i) {
    const bool bar = i == L::kBarBack || i == L::kBarRight;
    if (bar && linear.A.row(i).isZero(0.0) && linear.B.row(i).isZero(0.0)) continue;
    used.push_back(i);
    out.states.emplace_back(kNames[i]);
    out.state_units.emplace_back(i < L::kP ? "m/s" : i < L::kRollAngle ? "rad/s" : "rad");
  }
  const auto size = static_cast<Eigen::Index>(used.size());
  out.system.A.resize(size, size);
  out.system.B.resize(size, L::kInputs);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int row = used[static_cast<size_t>(i)];
    for (Eigen::Index j = 0; j < size; ++j) out.system.A(i, j) = linear.A(row, used[static_cast<size_t>(j)]);
    out.system.B.row(i) = linear.B.row(row);
  }
  return out;
}

std::optional<NamedLinearSystem> linear(const multicopter::MulticopterConfig& config, const Eigen::Vector3d& v_air_W) {
  const multicopter::MulticopterModel model = make_model(config);
  const std::optional<multicopter::MulticopterTrim> found = trim_of_any_speed(model, v_air_W);
  if (!found) return std::nullopt;
  const multicopter::MulticopterLinearModel linear = linearize(model, *found);
  return NamedLinearSystem{
      {"u", "v", "w", "p", "q", "r", "phi", "theta", "psi", "T", "L", "M", "N"},
      {"T_cmd", "L_cmd", "M_cmd", "N_cmd"},
      {"m/s", "m/s", "m/s", "rad/s", "rad/s", "rad/s", "rad", "rad", "rad", "N", "N m", "N m", "N m"},
      {"N", "N m", "N m", "N m"},
      {linear.A, linear.B}};
}

}  // namespace

double Quantity::margin_percent() const {
  const double above = highest ? *highest - value : HUGE_VAL, below = lowest ? value - *lowest : HUGE_VAL;
  const double scale = lowest && highest ? *highest - *lowest : std::abs(highest.value_or(lowest.value_or(0.0)));
  return 100.0 * std::min(above, below) / scale;
}

std::optional<std::string> Quantity::beyond() const {
  const bool over = highest && value > *highest;
  if (!over && !(lowest && value < *lowest)) return std::nullopt;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%s %.4g %s, limit %.4g %s", name.c_str(), value, unit.c_str(),
                over ? *highest : *lowest, unit.c_str());
  return text.data();
}

std::vector<std::string> SteadyFlight::beyond() const {
  std::vector<std::string> found;
  for (const Quantity& quantity : quantities) {
    if (std::optional<std::string> text = quantity.beyond()) found.push_back(*std::move(text));
  }
  return found;
}

std::optional<SteadyFlight> steady_flight(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W) {
  return std::visit([&](const auto& config) { return steady(config, v_air_W); }, vehicle);
}

std::optional<NamedLinearSystem> linear_system(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W) {
  return std::visit([&](const auto& config) { return linear(config, v_air_W); }, vehicle);
}

}  // namespace hedgehop::dynamics
