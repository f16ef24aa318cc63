#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/avionics.h"
#include "dynamics/sensors/sensor_errors.h"
#include "dynamics/vehicle.h"
#include "sim/config/input_error.h"
#include "sim/fields/field.h"
#include "sim/scenario/rig.h"

/// Failures in flight.
namespace hedgehop::sim {

struct FailureConfig {
  enum class Mode { off, stuck, bias, noise, black, factor };
  enum class Axis { x, y, z };

  double at_s = 0.0;
  std::optional<double> until_s;  ///< none: to the flight's end
  std::string what;               ///< a sensor, camera.<role>, motor.<number>, servo.<name> or link
  Mode mode = Mode::off;
  std::optional<double> value;  ///< of bias, noise and factor
  Axis axis = Axis::x;

  int64_t from_ns() const;
  int64_t until_ns() const;
  bool holds(int64_t t_ns) const { return t_ns >= from_ns() && t_ns < until_ns(); }
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FailureConfig> auto& c) {
  v("at", c.at_s,
    {.unit = "s", .at_least = 0.0, .at_most = 86400.0, .required = true, .meaning = "start of the failure"});
  v("until", c.until_s,
    {.unit = "s", .above = 0.0, .at_most = 86400.0, .meaning = "end of the failure; default: the end of the flight"});
  v("what", c.what,
    {.required = true,
     .meaning = "gyros, accelerometers, gps, gps_velocity, height_sensor, magnetometer, barometer, range_finder, "
                "velocimeter, camera.ROLE, motor.NUMBER (from 0), servo.collective, servo.lateral, servo.longitudinal, "
                "servo.tail, or link (from the module to the autopilot)"});
  v("mode", c.mode,
    {.choices = {"off", "stuck", "bias", "noise", "black", "factor"},
     .required = true,
     .meaning = "off: no output; stuck: the last reading, image or position; bias: value added; noise: white noise of "
                "standard deviation value; black: images of 0; factor: value times the command"});
  v("value", c.value,
    {.at_least = -1e6,
     .at_most = 1e6,
     .meaning = "of bias and noise, in rad/s (gyros), m/s^2, m/s, m, Pa, deg (magnetometer, servos) or s (link); of "
                "factor: share of the command that a motor or servo follows"});
  v("axis", c.axis,
    {.choices = {"x", "y", "z"},
     .meaning = "axis of a bias: forward, right, down (gyros, accelerometers, velocimeter); north, east, down (gps)"});
}

/// The parts of a scenario that may fail.
struct FailingParts {
  const RigConfig& rig;
  const dynamics::VehicleConfig& vehicle;
  const dynamics::AvionicsConfig& avionics;
  bool velocimeter = true;  ///< whether optic flow measures velocity
};
/// Returns the valid names of a scenario's failing devices: those on board.
std::vector<std::string> failing_names(const FailingParts& parts);

/// Returns the errors of a scenario's failures: names, modes, values, times, and two failures of one device at a time.
/// The paths begin with "failures".
std::vector<FieldError> failure_errors(std::span<const FailureConfig> failures, double duration_s,
                                       const FailingParts& parts);

/// Returns "20 s to 22 s: camera.front black".
std::string to_text(const FailureConfig& failure);

/// Returns the failures of sensors for the avionics. @param run_seed  of the flight; each failure has its own stream.
std::vector<dynamics::sensors::SensorFailure> sensor_failures(std::span<const FailureConfig> failures,
                                                              uint64_t run_seed);

/// Writes the actuator faults of the vehicle at a time.
void actuator_faults(std::span<const FailureConfig> failures, int64_t t_ns, std::vector<dynamics::ActuatorFault>& out);

/// Returns the failure of a device at a time, or null.
const FailureConfig* failure_of(std::span<const FailureConfig> failures, std::string_view what, int64_t t_ns);

}  // namespace hedgehop::sim
