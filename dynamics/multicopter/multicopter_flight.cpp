#include "dynamics/multicopter/multicopter_flight.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "dynamics/multicopter/multicopter_trim.h"
#include "dynamics/rigid_body.h"

namespace hedgehop::dynamics::multicopter {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

PerRotor zero_rates(const MulticopterModel& model) {
  return PerRotor::Zero(static_cast<Eigen::Index>(model.rotors.size()));
}

PerRotor speeds_for(const MulticopterModel& model, const Controls& wrench) {
  return (model.thrusts_of_wrench * wrench / model.rotor.thrust_ns2).cwiseMax(0.0).cwiseSqrt();
}

/// Returns the speeds after t_s of first-order motor response to `commanded`.
PerRotor speeds_after(const MulticopterModel& model, const PerRotor& speeds, const PerRotor& commanded, double t_s) {
  const LiftRotorConfig& c = model.rotor;
  PerRotor out = speeds;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double tau_s = commanded[i] > speeds[i] ? c.time_constant_up_s : c.time_constant_down_s;
    out[i] = commanded[i] + (speeds[i] - commanded[i]) * std::exp(-t_s / tau_s);
  }
  return out;
}

PerRotor spin_ups(const MulticopterModel& model, const PerRotor& speeds, const PerRotor& commanded) {
  const LiftRotorConfig& c = model.rotor;
  PerRotor out = speeds;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double tau_s = commanded[i] > speeds[i] ? c.time_constant_up_s : c.time_constant_down_s;
    out[i] = (commanded[i] - speeds[i]) / tau_s;
  }
  return out;
}

/// Returns the flight with this roll, pitch and wrench.
MulticopterTrim flight_at(const MulticopterModel& model, const Vector6& x, const Eigen::Vector3d& v_air_W,
                          double heading_rad) {
  MulticopterTrim t;
  t.roll_rad = x[0];
  t.pitch_rad = x[1];
  t.state.body.q_WB = from_roll_pitch_heading(x[0], x[1], heading_rad);
  t.state.body.v_WB_B = t.state.body.q_WB.conjugate() * v_air_W;
  t.state.speeds_radps = speeds_for(model, x.tail<4>());
  return t;
}

/// Returns the accelerations of a flight, linear, then angular.
Vector6 trim_residual(const MulticopterModel& model, const MulticopterTrim& t) {
  const MulticopterLoads loads =
      multicopter_loads(model, t.state.body, t.state.speeds_radps, zero_rates(model), Eigen::Vector3d::Zero());
  return derivative(model.mass, t.state.body, loads.f_B, loads.t_B).tail<6>();
}

}  // namespace

std::optional<MulticopterTrim> trim_of_any_speed(const MulticopterModel& model, const Eigen::Vector3d& v_air_W,
                                                 double heading_rad) {
  Vector6 x = Vector6::Zero();
  x[2] = model.mass.mass_kg * kGravityMps2;
  constexpr int kMaxSteps = 60;
  constexpr double kAtRest = 1e-11, kStep = 1e-6, kMaxTiltStep = 0.2;
  Vector6 f = trim_residual(model, flight_at(model, x, v_air_W, heading_rad));
  for (int i = 0; i < kMaxSteps && !(f.norm() < kAtRest); ++i) {
    Matrix6 J;
    for (int k = 0; k < 6; ++k) {
      Vector6 ahead = x, behind = x;
      ahead[k] += kStep;
      behind[k] -= kStep;
      J.col(k) = (trim_residual(model, flight_at(model, ahead, v_air_W, heading_rad)) -
                  trim_residual(model, flight_at(model, behind, v_air_W, heading_rad))) /
                 (2.0 * kStep);
    }
    Vector6 step = J.partialPivLu().solve(-f);
    const double tilt = step.head<2>().norm();
    if (tilt > kMaxTiltStep) step *= kMaxTiltStep / tilt;
    x += step;
    f = trim_residual(model, flight_at(model, x, v_air_W, heading_rad));
  }
  constexpr double kSettled = 1e-8;
  const MulticopterTrim found = flight_at(model, x, v_air_W, heading_rad);
  const bool turning = found.state.speeds_radps.allFinite() && found.state.speeds_radps.minCoeff() > 0.0;
  if (!(f.norm() < kSettled) || !turning) return std::nullopt;
  return found;
}

std::optional<MulticopterTrim> trim(const MulticopterModel& model, const Eigen::Vector3d& v_air_W, double heading_rad) {
  std::optional<MulticopterTrim> found = trim_of_any_speed(model, v_air_W, heading_rad);
  if (found && found->state.speeds_radps.maxCoeff() > model.rotor.highest_radps) return std::nullopt;
  return found;
}

MulticopterLinearModel linearize(const MulticopterModel& model, const MulticopterTrim& trim) {
  using L = MulticopterLinearModel;
  constexpr int kMoved = L::kThrust;  // rates by differences: those of the body
  const Controls wrench0 = wrench(model, trim.state.speeds_radps);
  const double heading0 = to_roll_pitch_heading(trim.state.body.q_WB)[2];
  const PerRotor none = zero_rates(model);
  const auto rate = [&](const Eigen::Matrix<double, L::kStates, 1>& d) {
    RigidBodyState body = trim.state.body;
    const Eigen::Vector3d rpy = Eigen::Vector3d(trim.roll_rad, trim.pitch_rad, heading0) + d.segment<3>(L::kRollAngle);
    body.q_WB = from_roll_pitch_heading(rpy[0], rpy[1], rpy[2]);
    body.v_WB_B += d.head<3>();
    body.w_WB_B += d.segment<3>(L::kP);
    const PerRotor speeds = speeds_for(model, wrench0 + d.tail<4>());
    const MulticopterLoads loads = multicopter_loads(model, body, speeds, none, Eigen::Vector3d::Zero());
    Eigen::Matrix<double, kMoved, 1> out;
    out.head<6>() = derivative(model.mass, body, loads.f_B, loads.t_B).tail<6>();
    const Eigen::Vector3d& w = body.w_WB_B;
    const double turning = w.y() * std::sin(rpy[0]) + w.z() * std::cos(rpy[0]);
    out.tail<3>() << w.x() + std::tan(rpy[1]) * turning, w.y() * std::cos(rpy[0]) - w.z() * std::sin(rpy[0]),
        turning / std::cos(rpy[1]);
    return out;
  };
  L linear;
  linear.A.setZero();
  linear.B.setZero();
  constexpr double kStep = 1e-5;
  for (int k = 0; k < L::kStates; ++k) {
    Eigen::Matrix<double, L::kStates, 1> d = Eigen::Matrix<double, L::kStates, 1>::Zero();
    d[k] = kStep;
    linear.A.col(k).head<kMoved>() = (rate(d) - rate(-d)) / (2.0 * kStep);
  }

  const double tau_s = 0.5 * (model.rotor.time_constant_up_s + model.rotor.time_constant_down_s);
  linear.A.bottomRightCorner<4, 4>() = -Eigen::Matrix4d::Identity() / tau_s;
  linear.B.bottomRows<4>() = Eigen::Matrix4d::Identity() / tau_s;
  // Reaction torque of accelerating rotors: h' per wrench' is constant, wrench' as in the rows above.
  Eigen::Matrix<double, 3, 4> spin = Eigen::Matrix<double, 3, 4>::Zero();
  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Eigen::RowVector4d speed_per_wrench =
        model.thrusts_of_wrench.row(k) / (2.0 * model.rotor.thrust_ns2 * trim.state.speeds_radps[k]);
    spin -= model.rotors[i].clockwise * model.rotor.inertia_kgm2 * model.rotors[i].n_B * speed_per_wrench;
  }
  linear.A.block<3, 4>(L::kP, L::kThrust) += model.mass.I_B_inv * spin / tau_s;
  linear.B.block<3, 4>(L::kP, 0) -= model.mass.I_B_inv * spin / tau_s;
  return linear;
}

MulticopterFlight::MulticopterFlight(const MulticopterConfig& config) : model_(make_model(config)) {
  reset(Eigen::Vector3d::Zero(), 0.0, Eigen::Vector3d::Zero());
}

void MulticopterFlight::reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  const std::optional<MulticopterTrim> hover = trim(model_, -wind_W, heading_rad);
  if (!hover) {
    throw std::invalid_argument(std::string("the multicopter has no steady hover") +
                                (wind_W.isZero() ? "" : " in this wind"));
  }
  MulticopterFlightState state = hover->state;
  state.body.p_WB = p_WB;
  state.body.v_WB_B.setZero();
  set_state(state, wind_W);
}

void MulticopterFlight::set_state(const MulticopterFlightState& state, const Eigen::Vector3d& wind_W) {
  state_ = state;
  const MulticopterLoads loads =
      multicopter_loads(model_, state_.body, state_.speeds_radps, zero_rates(model_), wind_W);
  specific_force_B_ = loads.f_B / model_.mass.mass_kg;
}

void MulticopterFlight::reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  MulticopterFlightState state{.body = {}, .speeds_radps = zero_rates(model_)};
  state.body.p_WB = p_WB;
  state.body.q_WB = from_roll_pitch_heading(0.0, 0.0, heading_rad);
  set_state(state, wind_W);
}

void MulticopterFlight::step_rotors(PerRotor commanded_radps, const Eigen::Vector3d& wind_W, double dt_s) {
  for (const ActuatorFault& fault : faults_) {
    const auto i = static_cast<Eigen::Index>(fault.actuator);
    commanded_radps[i] = faulty_command(fault, commanded_radps[i], state_.speeds_radps[i]);
  }
  step(commanded_radps, wind_W, dt_s);
}

void MulticopterFlight::step(const PerRotor& commanded_radps, const Eigen::Vector3d& wind_W, double dt_s) {
  const PerRotor commanded = commanded_radps.cwiseMax(0.0).cwiseMin(model_.rotor.highest_radps);
  const auto rate = [&](double t_s, const RigidBodyVector& x) -> RigidBodyVector {
    const PerRotor speeds = speeds_after(model_, state_.speeds_radps, commanded, t_s);
    const RigidBodyState body = to_rigid_body(x);
    const MulticopterLoads loads = multicopter_loads(model_, body, speeds, spin_ups(model_, speeds, commanded), wind_W);
    return derivative(model_.mass, body, loads.f_B, loads.t_B);
  };
  MulticopterFlightState next;
  next.body = to_rigid_body(rk4_step<13>(to_vector(state_.body), 0.0, dt_s, rate));
  next.body.q_WB.normalize();
  next.speeds_radps = speeds_after(model_, state_.speeds_radps, commanded, dt_s);
  set_state(next, wind_W);
}

}  // namespace hedgehop::dynamics::multicopter
