#include "dynamics/steady_flight.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "dynamics/helicopter/trim.h"

namespace hedgehop::dynamics {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

SteadyFlight described(const helicopter::Trim& t) {
  const helicopter::MainRotorLoads& main = t.loads.main_rotor;
  return {t.roll_rad,
          t.pitch_rad,
          {{"phi", "deg", t.roll_rad * kDegPerRad, "Attitude", "roll"},
           {"theta", "deg", t.pitch_rad * kDegPerRad, "Attitude", "pitch"},
           {"theta_c", "deg", t.blades.collective_rad * kDegPerRad, "Blade angles", "main collective"},
           {"theta_t", "deg", t.blades.tail_rad * kDegPerRad, "Blade angles", "tail collective"},
           {"delta_lat", "deg", t.blades.lateral_rad * kDegPerRad, "Blade angles", "lateral cyclic"},
           {"delta_lon", "deg", t.blades.longitudinal_rad * kDegPerRad, "Blade angles", "longitudinal cyclic"},
           {"T", "N", main.inflow.thrust_n, "Thrust", "main rotor"},
           {"v_i", "m/s", main.inflow.induced_mps, "Induced velocity", "main rotor"},
           {"P", "W", main.power_w, "Shaft power", "main rotor"},
           {"P_t", "W", t.loads.tail_rotor.power_w, "Shaft power", "tail rotor"}}};
}

SteadyFlight described(const multicopter::MulticopterModel& model, const multicopter::MulticopterTrim& t) {
  const Controls controls = multicopter::wrench(model, t.state.speeds_radps);
  return {t.roll_rad,
          t.pitch_rad,
          {{"phi", "deg", t.roll_rad * kDegPerRad, "Attitude", "roll"},
           {"theta", "deg", t.pitch_rad * kDegPerRad, "Attitude", "pitch"},
           {"T", "N", controls[kHeave], "Thrust", "all rotors"},
           {"L", "N m", controls[kRoll], "Torque of the rotors", "roll"},
           {"M", "N m", controls[kPitch], "Torque of the rotors", "pitch"},
           {"N", "N m", controls[kYaw], "Torque of the rotors", "yaw"},
           {"omega_min", "rad/s", t.state.speeds_radps.minCoeff(), "Rotor speeds", "slowest"},
           {"omega_max", "rad/s", t.state.speeds_radps.maxCoeff(), "Rotor speeds", "fastest"}}};
}

std::optional<SteadyFlight> steady(const helicopter::HelicopterConfig& config, const Eigen::Vector3d& v_air_W) {
  const std::optional<helicopter::Trim> found = trim(make_model(config), v_air_W);
  return found ? std::optional(described(*found)) : std::nullopt;
}

std::optional<SteadyFlight> steady(const multicopter::MulticopterConfig& config, const Eigen::Vector3d& v_air_W) {
  const multicopter::MulticopterModel model = make_model(config);
  const std::optional<multicopter::MulticopterTrim> found = trim(model, v_air_W);
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
  NamedLinearSystem out{{}, {"theta_c", "delta_lat", "delta_lon", "theta_t"}, {}};
  std::vector<int> used;  // a lumped stabilizer bar has no states of its own
  for (int i = 0; i < L::kStates; ++i) {
    const bool bar = i == L::kBarBack || i == L::kBarRight;
    if (bar && linear.A.row(i).isZero(0.0) && linear.B.row(i).isZero(0.0)) continue;
    used.push_back(i);
    out.states.emplace_back(kNames[i]);
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
  const std::optional<multicopter::MulticopterTrim> found = trim(model, v_air_W);
  if (!found) return std::nullopt;
  const multicopter::MulticopterLinearModel linear = linearize(model, *found);
  return NamedLinearSystem{{"u", "v", "w", "p", "q", "r", "phi", "theta", "psi", "T", "L", "M", "N"},
                           {"T_cmd", "L_cmd", "M_cmd", "N_cmd"},
                           {linear.A, linear.B}};
}

}  // namespace

std::optional<SteadyFlight> steady_flight(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W) {
  return std::visit([&](const auto& config) { return steady(config, v_air_W); }, vehicle);
}

std::optional<NamedLinearSystem> linear_system(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W) {
  return std::visit([&](const auto& config) { return linear(config, v_air_W); }, vehicle);
}

std::vector<Mode> modes(const control::DesignMatrix& A) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  std::vector<Mode> out;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i].imag() < 0.0) continue;
    const double magnitude = std::abs(values[i]);
    out.push_back({values[i], magnitude, magnitude > 0.0 ? -values[i].real() / magnitude : 0.0});
  }
  std::sort(out.begin(), out.end(), [](const Mode& a, const Mode& b) {
    return std::tuple(a.frequency_radps, a.eigenvalue.real()) < std::tuple(b.frequency_radps, b.eigenvalue.real());
  });
  return out;
}

}  // namespace hedgehop::dynamics
