#include "dynamics/helicopter/helicopter_flight.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "dynamics/helicopter/trim.h"
#include "dynamics/plausible_units.h"
#include "dynamics/rigid_body.h"
#include "sim/fields/quantities.h"

namespace hedgehop::dynamics::helicopter {
namespace {

/// Indices: HelicopterVector, then position and rate of each servo, then RotorSpeedState.
constexpr int kServo = 17, kRotor = 25, kSize = 27;
using FlightVector = Eigen::Matrix<double, kSize, 1>;

FlightVector to_vector(const HelicopterFlightState& state) {
  FlightVector x;
  x.head<kServo>() = to_vector(state.airframe);
  for (size_t i = 0; i < state.servos.size(); ++i) {
    x.segment<2>(kServo + 2 * static_cast<Eigen::Index>(i)) << state.servos[i].position_rad, state.servos[i].rate_radps;
  }
  x.tail<2>() << state.rotor.speed_radps, state.rotor.integral_throttle;
  return x;
}

HelicopterFlightState to_flight(const FlightVector& x) {
  HelicopterFlightState state{to_helicopter(x.head<kServo>()), {}, {x[kRotor], x[kRotor + 1]}};
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

/// Returns "the tail collective must be 11.1 deg, its stops are -20 and 5 deg".
std::string stop_words(size_t servo, double angle_rad, const ServoConfig& config) {
  constexpr std::array<const char*, 4> kNames = {"main collective", "lateral cyclic", "longitudinal cyclic",
                                                 "tail collective"};
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "the %s must be %.3g deg, its stops are %.4g and %.4g deg", kNames[servo],
                angle_rad * kDegPerRad, config.lowest_rad * kDegPerRad, config.highest_rad * kDegPerRad);
  return text.data() + stop_unit_advice(config.lowest_rad, config.highest_rad);
}

/// Returns "it weighs 785 N, its main rotor lifts at most 201 N", or the same of its tail rotor. If neither rotor is
/// too weak, it returns the figures of both.
std::string weak_rotor_words(const HelicopterModel& model) {
  const RotorDisc &main = model.main_rotor.disc, &tail = model.tail_rotor.disc;
  const double weight_n = model.mass.mass_kg * kGravityMps2;
  const double induced_mps = std::sqrt(weight_n / (2.0 * main.density_kgpm3 * main.area_m2 * main.efficiency));
  const double power_w = shaft_power_w(main, {.thrust_n = weight_n, .induced_mps = induced_mps}, 0.0, 0.0);
  const double torque_nm = power_w / model.main_rotor.speed_radps;
  const double tail_n = torque_nm / (model.tail_rotor.arm_m * model.tail_rotor.thrust_fraction);
  std::array<char, 120> lift{}, push{};
  std::snprintf(lift.data(), lift.size(), "it weighs %.4g N, its main rotor lifts at most %.4g N", weight_n,
                main.max_thrust_n);
  std::snprintf(push.data(), push.size(), "its tail rotor needs a thrust of %.3g N, its maximum is %.3g N", tail_n,
                tail.max_thrust_n);
  if (weight_n > main.max_thrust_n) {
    const std::string advice = rotor_speed_advice(model.main_rotor, weight_n);
    return lift.data() + (advice.empty() ? mass_unit_advice(model.mass.mass_kg, main.max_thrust_n) : advice);
  }
  if (tail_n > tail.max_thrust_n) return push.data();
  return std::string(lift.data()) + "; " + push.data();
}

}  // namespace

HelicopterFlight::HelicopterFlight(const HelicopterConfig& config)
    : model_(make_model(config)),
      servos_{config.servos.collective, config.servos.cyclic, config.servos.cyclic, config.servos.tail} {
  for (const ServoConfig& servo : servos_) check(servo);
  if (const auto* engine = std::get_if<GovernedEngineConfig>(&config.rotor_speed)) engine_ = *engine;
  reset(Eigen::Vector3d::Zero(), 0.0, Eigen::Vector3d::Zero());
}

void HelicopterFlight::reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  const std::optional<Trim> hover = trim(model_, -wind_W, heading_rad);
  const std::string where = wind_W.isZero() ? ": " : " in this wind: ";
  if (!hover) throw std::invalid_argument("the helicopter has no steady hover" + where + weak_rotor_words(model_));
  engine_on_ = true;
  HelicopterFlightState state{hover->state, {}, {model_.main_rotor.speed_radps, 0.0}};
  state.airframe.body.p_WB = p_WB;
  state.airframe.body.v_WB_B.setZero();
  const std::array<double, 4> blades = to_array(hover->blades);
  for (size_t i = 0; i < blades.size(); ++i) {
    if (blades[i] < servos_[i].lowest_rad || blades[i] > servos_[i].highest_rad) {
      throw std::invalid_argument("the helicopter cannot hover" + where + stop_words(i, blades[i], servos_[i]));
    }
    state.servos[i] = {blades[i], 0.0};
  }
  if (engine_) {
    const double power_w = hover->loads.main_rotor.power_w + hover->loads.tail_rotor.power_w;
    if (power_w > engine_->max_power_w) {
      std::array<char, 80> text{};
      std::snprintf(text.data(), text.size(), "it needs %.4g W, its engine gives %.4g W", power_w,
                    engine_->max_power_w);
      throw std::invalid_argument("the helicopter cannot hover" + where + text.data());
    }
    state.rotor.integral_throttle = power_w / engine_->max_power_w;
  }
  set_state(state, wind_W);
}

void HelicopterFlight::reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  engine_on_ = true;
  HelicopterFlightState state{{}, {}, {engine_ ? 0.0 : model_.main_rotor.speed_radps, 0.0}};
  state.airframe.body.p_WB = p_WB;
  state.airframe.body.q_WB = from_roll_pitch_heading(0.0, 0.0, heading_rad);
  for (size_t i = 0; i < servos_.size(); ++i) state.servos[i] = within_limits(servos_[i], {});
  set_state(state, wind_W);
}

void HelicopterFlight::step(const BladeAngles& command, const Eigen::Vector3d& wind_W, double dt_s) {
  std::array<double, 4> targets = to_array(command);
  for (const ActuatorFault& fault : faults_) {
    ServoState& servo = state_.servos[fault.actuator];
    if (fault.kind == ActuatorFault::Kind::stuck) servo.rate_radps = 0.0;
    targets[fault.actuator] = faulty_command(fault, targets[fault.actuator], servo.position_rad);
  }
  const auto rate = [&](double, const FlightVector& x) {
    const HelicopterFlightState state = to_flight(x);
    FlightVector dx;
    dx.tail<2>().setZero();
    if (engine_) {
      // The reaction torque of the rotors' acceleration acts on the body.
      const HelicopterModel model = at_speed(model_, state.rotor.speed_radps);
      HelicopterLoads loads = helicopter_loads(model, state.airframe, blade_angles(state), wind_W);
      const double power_w = loads.main_rotor.power_w + loads.tail_rotor.power_w;
      dx.tail<2>() = engine_on_ ? derivative(*engine_, model_.main_rotor.speed_radps, state.rotor, power_w)
                                : coasting(*engine_, model_.main_rotor.speed_radps, state.rotor, power_w);
      loads.t_B.z() -= model.main_rotor.flapping.clockwise * engine_->inertia_kgm2 * dx[kRotor];
      dx.head<kServo>() = derivative(model, state.airframe, loads);
    } else {
      dx.head<kServo>() = derivative(model_, state.airframe, blade_angles(state), wind_W);
    }
    for (size_t i = 0; i < targets.size(); ++i) {
      dx.segment<2>(kServo + 2 * static_cast<Eigen::Index>(i)) = derivative(servos_[i], state.servos[i], targets[i]);
    }
    return dx;
  };
  HelicopterFlightState next = to_flight(rk4_step<kSize>(to_vector(state_), 0.0, dt_s, rate));
  next.airframe.body.q_WB.normalize();
  for (size_t i = 0; i < servos_.size(); ++i) next.servos[i] = within_limits(servos_[i], next.servos[i]);
  next.rotor.speed_radps = std::max(next.rotor.speed_radps, 0.0);
  set_state(next, wind_W);
}

BladeAngles HelicopterFlight::actuators() const { return blade_angles(state_); }

void HelicopterFlight::set_state(const HelicopterFlightState& state, const Eigen::Vector3d& wind_W) {
  state_ = state;
  const HelicopterLoads loads = helicopter_loads(model_at(state_.rotor), state_.airframe, actuators(), wind_W);
  specific_force_B_ = loads.f_B / model_.mass.mass_kg;
  within_validity_ = loads.main_rotor.inflow.within_momentum_theory;
}

}  // namespace hedgehop::dynamics::helicopter
