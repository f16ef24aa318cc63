#include "sim/flightlog/replay.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "dynamics/control/autopilot.h"

namespace hedgehop::sim {
namespace {

using dynamics::RigidBodyState;
using dynamics::helicopter::HelicopterFlight;
using dynamics::multicopter::MulticopterFlight;
using Inputs = LogColumnsConfig::Inputs;

constexpr double kMaxStepS = 0.002;  // as Vehicle::step()

std::variant<HelicopterFlight, MulticopterFlight> make_flight(const dynamics::VehicleConfig& vehicle) {
  if (const auto* const multicopter = std::get_if<dynamics::multicopter::MulticopterConfig>(&vehicle)) {
    return MulticopterFlight(*multicopter);
  }
  return HelicopterFlight(std::get<dynamics::helicopter::HelicopterConfig>(vehicle));
}

RigidBodyState& body_of(dynamics::helicopter::HelicopterFlightState& state) { return state.airframe.body; }
RigidBodyState& body_of(dynamics::multicopter::MulticopterFlightState& state) { return state.body; }

dynamics::control::NavigationEstimate perfect_estimate(const RigidBodyState& body) {
  dynamics::control::NavigationEstimate now;
  now.p_WB_est = body.p_WB;
  now.q_WB_est = now.q_WB_gyro = body.q_WB;
  now.v_WB_B_est = body.v_WB_B;
  now.w_WB_B_est = body.w_WB_B;
  now.height_above_ground_m = std::max(0.0, -body.p_WB.z());
  return now;
}

}  // namespace

/// One vehicle of either kind, driven by the inputs of a log.
class Replay::Flyer {
 public:
  explicit Flyer(const dynamics::VehicleConfig& vehicle) : vehicle_(vehicle), flight_(make_flight(vehicle)) {}

  /// Puts the vehicle at a measured state with its actuators at rest under the input of that sample.
  void begin(const RecordedFlight& log, size_t sample) {
    std::visit([](auto& flight) { flight.reset(Eigen::Vector3d::Zero(), 0.0, Eigen::Vector3d::Zero()); }, flight_);
    place(log, sample);
    settle(log, sample);
    if (log.kind != Inputs::setpoints) return;
    fly_steadily(log, sample);
    place(log, sample);
  }

  /// Puts the body at the measured state of a sample.
  void place(const RecordedFlight& log, size_t sample) {
    std::visit(
        [&](auto& flight) {
          auto state = flight.state();
          body_of(state) = log.states[sample];
          flight.set_state(state, log.wind_W[sample]);
        },
        flight_);
  }

  /// Sets the rotor speeds or control positions that the log has measured; without effect for other inputs.
  void measure(const RecordedFlight& log, size_t sample) {
    if (log.kind == Inputs::motor_speeds || log.kind == Inputs::control_positions) settle(log, sample);
  }

  /// Flies from one sample to the next with the input of the first.
  void advance(const RecordedFlight& log, size_t sample) {
    measure(log, sample);
    fly(command_of(log, sample), log, sample, log.t_s[sample + 1] - log.t_s[sample]);
  }

  const RigidBodyState& body() const {
    return std::visit([](const auto& flight) -> const RigidBodyState& { return flight.body(); }, flight_);
  }
  const Eigen::Vector3d& specific_force_B() const {
    return std::visit([](const auto& flight) -> const Eigen::Vector3d& { return flight.specific_force_B(); }, flight_);
  }

 private:
  /// Sets rotor speeds and servos to the input of a sample.
  void settle(const RecordedFlight& log, size_t sample) {
    const bool controls = log.kind == Inputs::controls || log.kind == Inputs::control_positions;
    const Eigen::VectorXd input = log.inputs.row(static_cast<Eigen::Index>(sample)).transpose();
    if (auto* const multicopter = std::get_if<MulticopterFlight>(&flight_)) {
      if (log.kind == Inputs::setpoints) return;
      auto state = multicopter->state();
      state.speeds_radps =
          controls ? allocate(multicopter->model(), dynamics::Controls(input))
                   : dynamics::multicopter::PerRotor(input.cwiseMin(multicopter->model().rotor.highest_radps));
      multicopter->set_state(state, log.wind_W[sample]);
    } else if (controls) {
      auto& helicopter = std::get<HelicopterFlight>(flight_);
      auto state = helicopter.state();
      for (size_t i = 0; i < state.servos.size(); ++i) state.servos[i] = {input[static_cast<Eigen::Index>(i)], 0.0};
      helicopter.set_state(state, log.wind_W[sample]);
    }
  }

  /// Flies with the autopilot, from a hover, at the measured velocity, altitude and heading of a sample until the
  /// flight is steady: the autopilot's reference flight and integrals, the actuators and the rotor are those of this
  /// flight.
  void fly_steadily(const RecordedFlight& log, size_t sample) {
    constexpr double kSteadyS = 1.0, kLongestS = 15.0;
    constexpr double kSpeedMps = 0.02, kRateRadps = 0.01, kBelowM = 0.02;  // far below the errors of a replay
    const RigidBodyState& measured = log.states[sample];
    const Eigen::Vector3d v_WB_W = measured.q_WB * measured.v_WB_B;
    const double heading_rad = dynamics::to_roll_pitch_heading(measured.q_WB)[2];
    std::visit([&](auto& flight) { flight.reset(measured.p_WB, heading_rad, Eigen::Vector3d::Zero()); }, flight_);
    if (!autopilot_) {
      // Commands of a log are within the speed limit that its flight had.
      constexpr double kNoSpeedLimitMps = 20.0;
      autopilot_.emplace(dynamics::control::AutopilotConfig{.speed_limit_mps = kNoSpeedLimitMps}, vehicle_);
    }
    autopilot_->reset(perfect_estimate(body()));
    const dynamics::control::VelocitySetpoint setpoint{
        .v_WB_W = v_WB_W.head<2>(), .altitude_m = -measured.p_WB.z(), .heading_rad = heading_rad};
    double steady_s = 0.0;
    for (double t_s = 0.0; t_s < kLongestS && steady_s < kSteadyS; t_s += log.period_s) {
      fly(autopilot_->control(setpoint, perfect_estimate(body()), log.period_s), log, sample, log.period_s);
      const Eigen::Vector3d v_W = body().q_WB * body().v_WB_B;
      const bool steady = (v_W.head<2>() - v_WB_W.head<2>()).norm() < kSpeedMps && std::abs(v_W.z()) < kSpeedMps &&
                          body().w_WB_B.norm() < kRateRadps && std::abs(body().p_WB.z() - measured.p_WB.z()) < kBelowM;
      steady_s = steady ? steady_s + log.period_s : 0.0;
    }
  }

  /// Flies for a time with one command, in the wind of a sample.
  void fly(const dynamics::ActuatorCommand& command, const RecordedFlight& log, size_t sample, double time_s) {
    const auto steps = std::max(1.0, std::ceil(time_s / kMaxStepS - 1e-9));
    const double step_s = time_s / steps;
    for (int i = 0; i < static_cast<int>(steps); ++i) step(with_feedback(command, log), log.wind_W[sample], step_s);
  }

  dynamics::ActuatorCommand command_of(const RecordedFlight& log, size_t sample) {
    const Eigen::VectorXd input = log.inputs.row(static_cast<Eigen::Index>(sample)).transpose();
    switch (log.kind) {
      case Inputs::motor_speeds:
      case Inputs::pwm:
        return dynamics::multicopter::PerRotor(input);
      case Inputs::controls:
      case Inputs::control_positions:
        return dynamics::Controls(input);
      case Inputs::setpoints:
        break;
    }
    const dynamics::control::VelocitySetpoint setpoint{
        .v_WB_W = input.head<2>(), .altitude_m = input[2], .heading_rad = input[3]};
    return autopilot_->control(setpoint, perfect_estimate(body()), log.period_s);
  }

  /// Returns the command with the part of a rate controller on board, see LogColumnsConfig.
  dynamics::ActuatorCommand with_feedback(const dynamics::ActuatorCommand& command, const RecordedFlight& log) const {
    if (log.rate_feedback.isZero() && log.torque_share == 1.0) return command;
    const Eigen::Vector3d damping = log.rate_feedback.cwiseProduct(body().w_WB_B);
    const auto* const multicopter = std::get_if<MulticopterFlight>(&flight_);
    if (multicopter && log.kind == Inputs::pwm) {
      const auto& model = multicopter->model();
      dynamics::Controls wrench_cmd = wrench(model, std::get<dynamics::multicopter::PerRotor>(command));
      wrench_cmd.tail<3>() = log.torque_share * wrench_cmd.tail<3>() - model.mass.I_B * damping;
      return allocate(model, wrench_cmd);
    }
    if (multicopter || log.kind != Inputs::controls) return command;
    dynamics::Controls controls = std::get<dynamics::Controls>(command);
    controls.tail<3>() -= damping;
    return controls;
  }

  void step(const dynamics::ActuatorCommand& command, const Eigen::Vector3d& wind_W, double step_s) {
    std::visit(
        [&](auto& flight) {
          if (const auto* const controls = std::get_if<dynamics::Controls>(&command)) {
            flight.step_controls(*controls, wind_W, step_s);
          } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(flight)>, MulticopterFlight>) {
            flight.step(std::get<dynamics::multicopter::PerRotor>(command), wind_W, step_s);
          }
        },
        flight_);
  }

  dynamics::VehicleConfig vehicle_;
  std::variant<HelicopterFlight, MulticopterFlight> flight_;
  std::optional<dynamics::control::Autopilot> autopilot_;
};

Replay::Replay(const dynamics::VehicleConfig& vehicle) : flyer_(std::make_unique<Flyer>(vehicle)) {}

Replay::~Replay() = default;

void Replay::warm_up(const RecordedFlight& flight, size_t start) {
  size_t first = start;
  while (first > 0 && !flight.gap_after[first - 1] && flight.t_s[start] - flight.t_s[first - 1] <= flight.warm_up_s)
    --first;
  flyer_->begin(flight, first);
  for (size_t i = first; i < start; ++i) {
    flyer_->advance(flight, i);
    flyer_->place(flight, i + 1);
  }
  flyer_->measure(flight, start);
}

std::vector<RigidBodyState> Replay::predict(const RecordedFlight& flight, size_t start, size_t count) {
  warm_up(flight, start);
  std::vector<RigidBodyState> states;
  states.reserve(count);
  for (size_t i = start; i < start + count; ++i) {
    flyer_->advance(flight, i);
    states.push_back(flyer_->body());
  }
  return states;
}

std::vector<Eigen::Vector3d> Replay::specific_forces_B(const RecordedFlight& flight, size_t begin, size_t end) {
  std::vector<Eigen::Vector3d> forces;
  if (begin >= end) return forces;
  warm_up(flight, begin);
  for (size_t i = begin; i < end; ++i) {
    forces.push_back(flyer_->specific_force_B());
    if (i + 1 == end) break;
    if (flight.gap_after[i]) {
      warm_up(flight, i + 1);
      continue;
    }
    flyer_->advance(flight, i);
    flyer_->place(flight, i + 1);
    flyer_->measure(flight, i + 1);
  }
  return forces;
}

}  // namespace hedgehop::sim
