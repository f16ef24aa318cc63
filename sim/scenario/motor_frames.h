#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/multicopter/multicopter.h"
#include "sim/config/input_error.h"

/// ArduPilot's multicopter frames and the motors of our vehicles.
namespace hedgehop::sim {

/// A motor of a frame.
struct FrameMotor {
  double azimuth_deg = 0.0;  ///< from the nose, clockwise from above
  bool clockwise = true;     ///< sense of rotation of the propeller, from above
};

/// Returns the motors of a frame in the order of its servo outputs; empty for a frame that is not in the table.
std::span<const FrameMotor> frame_motors(int64_t frame_class, int64_t frame_type);

/// The match of a vehicle's arms with a frame's motors.
struct MotorMatch {
  std::vector<size_t> arm_of_motor;  ///< index of the arm of each servo output; empty with errors
  std::vector<FieldError> errors;    ///< their paths begin with "vehicle" or "link"
};
/// Matches each arm with the motor of the same azimuth, within 10 degrees, and the same sense of rotation. In frames
/// with two motors on an arm, the order of both is that of the arms. @param path  of the map with frame_class and
/// frame_type, for errors: "link" for PX4.
MotorMatch match_motors(const dynamics::multicopter::MulticopterConfig& vehicle, int64_t frame_class,
                        int64_t frame_type, std::string_view path = "link.multicopter");

}  // namespace hedgehop::sim
