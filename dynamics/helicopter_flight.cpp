#include "dynamics/helicopter_flight.h"

#include <stdexcept>
#include <utility>

#include "dynamics/integrator.h"
#include "dynamics/trim.h"

namespace hedgehop::dynamics {
namespace {

/// HelicopterVector, then position and rate of each servo.
using FlightVector = Eigen::Matrix<double, 25, 1>;
constexpr int kServo = 17;

FlightVector to_vector(const HelicopterFlightState& state) {
  FlightVector x;
  x.head<kServo>() = to_vector(state.airframe);
  for (size_t i = 0; i < state.servos.size(); ++i) {
    x.segment<2>(kServo + 2 * static_cast<Eigen::Index>(i)) << state.servos[i].position_rad, state.servos[i].rate_radps;
  }
  return x;
}

HelicopterFlightState to_flight(const FlightVector& x) {
  HelicopterFlightState state{to_helicopter(x.head<kServo>()), {}};
  for (size_t i = 0; i < state.servos.size(); ++i) {
    const Eigen::Index k = kServo + 2 * static_cast<Eigen::Index>(i);
    state.servos[i] = {x[k], x[k + 1]};
  }
  return state;
}

std::array<double, 4> to_array(const BladeAngles& c) {
  return {c.collective_rad, c.lateral_rad, c.longitudinal_rad, c.tail_rad};
}

BladeAngles blade_angles(const HelicopterFlightState& state) {
  const std::array<ServoState, 4>& s = state.servos;
  return {s[0].position_rad, s[1].position_rad, s[2].position_rad, s[3].position_rad};
}

}  // namespace

HelicopterFlight::HelicopterFlight(const HelicopterConfig& config)
    : model_(make_model(config)),
      servos_{config.servos.collective, config.servos.cyclic, config.servos.cyclic, config.servos.tail} {
  for (const ServoConfig& servo : servos_) check(servo);
  reset(Eigen::Vector3d::Zero(), 0.0, Eigen::Vector3d::Zero());
}

void HelicopterFlight::reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  const std::optional<Trim> hover = trim(model_, -wind_W, heading_rad);
  if (!hover) throw std::invalid_argument("the helicopter has no steady hover in this wind");
  HelicopterFlightState state{hover->state, {}};
  state.airframe.body.p_WB = p_WB;
  state.airframe.body.v_WB_B.setZero();
  const std::array<double, 4> blades = to_array(hover->blades);
  for (size_t i = 0; i < blades.size(); ++i) {
    if (blades[i] < servos_[i].lowest_rad || blades[i] > servos_[i].highest_rad) {
      throw std::invalid_argument("the helicopter cannot hover in this wind: a servo's travel is too small");
    }
    state.servos[i] = {blades[i], 0.0};
  }
  set_state(state, wind_W);
}

void HelicopterFlight::step(const BladeAngles& command, const Eigen::Vector3d& wind_W, double dt_s) {
  const std::array<double, 4> targets = to_array(command);
  const auto rate = [&](double, const FlightVector& x) {
    const HelicopterFlightState state = to_flight(x);
    FlightVector dx;
    dx.head<kServo>() = derivative(model_, state.airframe, blade_angles(state), wind_W);
    for (size_t i = 0; i < targets.size(); ++i) {
      dx.segment<2>(kServo + 2 * static_cast<Eigen::Index>(i)) = derivative(servos_[i], state.servos[i], targets[i]);
    }
    return dx;
  };
  HelicopterFlightState next = to_flight(rk4_step<25>(to_vector(state_), 0.0, dt_s, rate));
  next.airframe.body.q_WB.normalize();
  for (size_t i = 0; i < servos_.size(); ++i) next.servos[i] = within_limits(servos_[i], next.servos[i]);
  set_state(next, wind_W);
}

BladeAngles HelicopterFlight::actuators() const { return blade_angles(state_); }

void HelicopterFlight::set_state(const HelicopterFlightState& state, const Eigen::Vector3d& wind_W) {
  state_ = state;
  const HelicopterLoads loads = helicopter_loads(model_, state_.airframe, actuators(), wind_W);
  specific_force_B_ = loads.f_B / model_.mass.mass_kg;
  within_validity_ = loads.main_rotor.inflow.within_momentum_theory;
}

}  // namespace hedgehop::dynamics
