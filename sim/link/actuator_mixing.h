#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/vehicle.h"
#include "sim/link/servo_packet.h"
#include "sim/link/swashplate.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/scenario/link_config.h"

namespace hedgehop::sim::link {

/// Converts servo pulses to the actuator commands of a vehicle.
class ActuatorMixing {
 public:
  /// Throws InputError if the vehicle does not fit the link (link_errors()).
  ActuatorMixing(const ArduPilotLinkConfig& link, const dynamics::VehicleConfig& vehicle);

  /// A motor without a pulse stops; a servo without a pulse keeps its last one, at first its trim.
  OutsideCommand command(const ServoPacket& packet);

 private:
  OutsideCommand rotor_speeds(const ServoPacket& packet) const;
  OutsideCommand blade_angles(const ServoPacket& packet);

  MulticopterLinkConfig motors_;
  std::vector<size_t> arm_of_motor_;  ///< of a multicopter
  double highest_radps_ = 0.0;

  std::optional<HelicopterLinkConfig> servos_;  ///< of a helicopter
  std::optional<SwashplateInverse> swashplate_;
  dynamics::helicopter::ServosConfig blades_;
  bool clockwise_ = true;
  std::array<double, 8> pulse_us_{};  ///< of SERVO1 .. 8 of a helicopter
};

}  // namespace hedgehop::sim::link
