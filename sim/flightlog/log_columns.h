#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/fields/field.h"

/// The columns of recorded flights: which column of a foreign log holds which quantity.
namespace hedgehop::sim {

/// One quantity of a log: `scale * column + offset`.
struct LogColumnConfig {
  std::string name;  ///< of the quantity, see log_quantities()
  std::string from;  ///< column of the file; empty: the column of the quantity's own name
  double scale = 1.0, offset = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LogColumnConfig> auto& c) {
  v("name", c.name, {.required = true, .meaning = "quantity, such as p_radps or motor_0_radps"});
  v("from", c.from, {.meaning = "column of the file; default: the one of this name"});
  v("scale", c.scale, {.meaning = "factor to the quantity's unit"});
  v("offset", c.offset, {.meaning = "added after the factor, in the quantity's unit"});
}

/// Rotor speed from a motor's duty cycle d and the battery's voltage V:
/// speed = (at_zero + per_duty * trim * d) * (V / voltage)^exponent. A first-order motor follows, see LiftRotorConfig.
struct DutySpeedConfig {
  double at_zero_radps = 0.0, per_duty_radps = 1000.0;
  double voltage_v = 4.0, voltage_exponent = 0.0;
  double torque_share = 1.0;
  std::vector<double> trims;  ///< per motor; empty: all 1
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<DutySpeedConfig> auto& c) {
  v("at_zero", c.at_zero_radps, {.unit = "rad/s", .meaning = "rotor speed that the line has at duty cycle 0"});
  v("per_duty", c.per_duty_radps, {.unit = "rad/s", .above = 0.0, .meaning = "rotor speed per duty cycle"});
  v("voltage", c.voltage_v, {.unit = "V", .above = 0.0, .meaning = "battery voltage of the line"});
  v("voltage_exponent", c.voltage_exponent,
    {.at_least = 0.0, .at_most = 2.0, .meaning = "exponent of the voltage ratio; 0 ignores the voltage"});
  v("torque_share", c.torque_share,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning =
         "share of the rotors' torques that acts; below 1 for a log that samples a faster controller and so aliases "
         "its noise"});
  v("trims", c.trims, {.above = 0.0, .meaning = "factor of each motor's duty cycle"});
}

/// How to read a log, and how its inputs act.
struct LogColumnsConfig {
  enum class Axes { frd, flu };
  /// control_positions are the columns of `controls` with positions that servos or motors have reached.
  enum class Inputs { motor_speeds, pwm, controls, setpoints, control_positions };
  static constexpr std::array<std::string_view, 5> kInputNames = {"motor_speeds", "pwm", "controls", "setpoints",
                                                                  "control_positions"};
  Axes axes = Axes::frd;
  std::optional<Inputs> inputs;  ///< default: the first of these kinds whose columns the log has
  double warm_up_s = 0.5;
  Eigen::Vector3d rate_feedback = Eigen::Vector3d::Zero();
  DutySpeedConfig pwm;
  std::vector<LogColumnConfig> columns;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LogColumnsConfig> auto& c) {
  v("axes", c.axes,
    {.choices = {"frd", "flu"},
     .meaning = "axes of the log, of its states and of commanded velocity, heading and torques: frd (world "
                "north-east-down, body forward-right-down) or flu (world with z up, body forward-left-up)"});
  v("inputs", c.inputs,
    {.choices = {LogColumnsConfig::kInputNames.begin(), LogColumnsConfig::kInputNames.end()},
     .meaning = "recorded inputs; default: the first of these whose columns the log has; control_positions, in the "
                "columns of controls, are positions that servos or motors have reached, as in trajectory.csv"});
  v("warm_up", c.warm_up_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 10.0,
     .meaning = "time before each window in which the body follows the log, while motors, servos, rotor and autopilot "
                "settle"});
  v("rate_feedback", c.rate_feedback,
    {.at_least = 0.0,
     .at_most = 100.0,
     .meaning =
         "damping of roll, pitch and yaw rate by a controller on board whose output the log lacks: of a helicopter "
         "blade angle per rate, s; of motors driven by pwm angular acceleration per rate, 1/s"});
  v("pwm", c.pwm, {.meaning = "rotor speed from duty cycle and voltage"});
  v("columns", c.columns, {.meaning = "columns with other names, units or signs than Hedgehop's"});
}

/// Reads such a YAML file strictly. Throws InputError with every error found.
LogColumnsConfig read_log_columns(const std::filesystem::path& file);

/// Returns the names of all quantities that a log may have.
std::vector<std::string_view> log_quantities();

}  // namespace hedgehop::sim
