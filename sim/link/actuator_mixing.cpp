#include "sim/link/actuator_mixing.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/scenario/motor_frames.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::link {
namespace {

constexpr double kFullCyclic = 4500.0;  // unit of H_CYC_MAX, at which ArduPilot's roll and pitch are 1
constexpr double kThrottleOn = 0.4;     // below ArduPilot's set point of the throttle, above its idle
constexpr size_t kTailServo = 3, kFourthServo = 4, kThrottleServo = 7;  // SERVO4, 5 and 8

/// Returns 0 at `from`, 1 at `to`.
double share(double value, double from, double to) { return std::clamp((value - from) / (to - from), 0.0, 1.0); }

}  // namespace

ActuatorMixing::ActuatorMixing(const ArduPilotLinkConfig& link, const dynamics::VehicleConfig& vehicle)
    : motors_(link.multicopter) {
  if (const auto* const multicopter = std::get_if<dynamics::multicopter::MulticopterConfig>(&vehicle)) {
    MotorMatch match = match_motors(*multicopter, motors_.frame_class, motors_.frame_type);
    if (!match.errors.empty()) throw InputError(std::move(match.errors));
    arm_of_motor_ = std::move(match.arm_of_motor);
    highest_radps_ = multicopter->rotor.highest_radps;
    return;
  }
  const auto& helicopter = std::get<dynamics::helicopter::HelicopterConfig>(vehicle);
  if (!link.helicopter) throw InputError(FieldError{"link.helicopter", "is missing; the vehicle is a helicopter"});
  servos_ = link.helicopter;
  swashplate_.emplace(build_part("link.helicopter", [&] { return SwashplateInverse(*servos_); }));
  blades_ = helicopter.servos;
  clockwise_ = helicopter.main_rotor.turns == dynamics::helicopter::MainRotorConfig::Turns::clockwise;
  pulse_us_.fill(1500.0);
  for (size_t i = 0; i < servos_->trim_us.size(); ++i) pulse_us_[i < 3 ? i : kFourthServo] = servos_->trim_us[i];
  pulse_us_[kTailServo] = servos_->tail.trim_us;
  pulse_us_[kThrottleServo] = servos_->throttle_min_us;
}

OutsideCommand ActuatorMixing::command(const ServoPacket& packet) {
  return servos_ ? blade_angles(packet) : rotor_speeds(packet);
}

OutsideCommand ActuatorMixing::rotor_speeds(const ServoPacket& packet) const {
  dynamics::multicopter::PerRotor speeds_radps(static_cast<Eigen::Index>(arm_of_motor_.size()));
  for (size_t motor = 0; motor < arm_of_motor_.size(); ++motor) {
    const double pulse_us = packet.pulse_us[motor];
    speeds_radps[static_cast<Eigen::Index>(arm_of_motor_[motor])] =
        pulse_us == 0.0 ? 0.0 : highest_radps_ * share(pulse_us, motors_.pwm_min_us, motors_.pwm_max_us);
  }
  return {.actuators = speeds_radps};
}

OutsideCommand ActuatorMixing::blade_angles(const ServoPacket& packet) {
  for (size_t i = 0; i < pulse_us_.size(); ++i) {
    if (packet.pulse_us[i] != 0) pulse_us_[i] = packet.pulse_us[i];
  }
  const HelicopterLinkConfig& c = *servos_;
  const SwashCommand swash =
      swashplate_->command(std::array{pulse_us_[0], pulse_us_[1], pulse_us_[2], pulse_us_[kFourthServo]});
  dynamics::Controls blades;
  blades[dynamics::kHeave] =
      std::lerp(c.collective_low_rad, c.collective_high_rad,
                share(1000.0 + 1000.0 * swash.collective, c.collective_min_us, c.collective_max_us));
  const double cyclic_rad =
      std::min(-blades_.cyclic.lowest_rad, blades_.cyclic.highest_rad) * kFullCyclic / c.cyclic_max;
  blades[dynamics::kRoll] = cyclic_rad * swash.roll;
  blades[dynamics::kPitch] = cyclic_rad * swash.pitch;

  // The blade angle opposes the torque of the main rotor: it turns the nose right under a clockwise rotor.
  const double tail_us = pulse_us_[kTailServo];
  const double right = tail_us >= c.tail.trim_us ? share(tail_us, c.tail.trim_us, c.tail.max_us)
                                                 : -share(tail_us, c.tail.trim_us, c.tail.min_us);
  const double against_torque = clockwise_ ? right : -right;
  const double stop_rad = against_torque >= 0.0 ? blades_.tail.highest_rad : blades_.tail.lowest_rad;
  blades[dynamics::kYaw] = c.tail_trim_rad + std::abs(against_torque) * (stop_rad - c.tail_trim_rad);
  const bool engine_on = share(pulse_us_[kThrottleServo], c.throttle_min_us, c.throttle_max_us) > kThrottleOn &&
                         packet.pulse_us[kThrottleServo] != 0;
  return {.actuators = blades, .engine_on = engine_on};
}

}  // namespace hedgehop::sim::link
