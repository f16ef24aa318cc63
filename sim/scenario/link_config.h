#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/fields/field.h"
#include "sim/mavlink/companion_config.h"
#include "sim/scenario/autopilot_start_config.h"
#include "sim/scenario/px4_link_config.h"

/// The link to an autopilot outside this process, which flies the vehicle instead of Hedgehop's own autopilot.
namespace hedgehop::sim {

/// A range finder whose true distances the autopilot receives.
struct LinkRangeFinderConfig {
  Eigen::Vector3d direction_B = Eigen::Vector3d::UnitZ();  ///< of the beam; any length except 0
  Eigen::Vector3d p_BI_m = Eigen::Vector3d::Zero();        ///< origin of the beam, from the mass center, in B
  double max_m = 40.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LinkRangeFinderConfig> auto& c) {
  v("direction", c.direction_B, {.meaning = "direction of the beam: forward, right, down; any length except 0"});
  v("position", c.p_BI_m, {.unit = "m", .meaning = "origin of the beam: forward, right, down of the mass center"});
  v("max", c.max_m, {.unit = "m", .above = 0.0, .meaning = "maximum range; beyond it the autopilot receives -1"});
}

/// A servo's pulses at its lower end, its center and its upper end.
struct PulseRangeConfig {
  double min_us = 1000.0, trim_us = 1500.0, max_us = 2000.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PulseRangeConfig> auto& c) {
  v("min", c.min_us, {.unit = "us", .at_least = 500.0, .at_most = 2500.0, .meaning = "pulse of the lower end"});
  v("trim", c.trim_us, {.unit = "us", .at_least = 500.0, .at_most = 2500.0, .meaning = "pulse of the center"});
  v("max", c.max_us, {.unit = "us", .at_least = 500.0, .at_most = 2500.0, .meaning = "pulse of the upper end"});
}

/// Meaning of a helicopter's servo pulses: ArduPilot's H_* parameters, and the blade angles of our vehicle.
struct HelicopterLinkConfig {
  /// In the order of H_SW_TYPE.
  enum class Swashplate { h3, h1, h3_140, h3_120, h4_90, h4_45 };
  Swashplate swashplate = Swashplate::h3_120;
  Eigen::Vector3d h3_azimuth_rad{-1.0471975511965976, 1.0471975511965976, 3.141592653589793};
  double h3_phase_rad = 0.0;
  std::vector<double> trim_us;  ///< of SERVO1, 2, 3 and, with four servos, 5; empty: 1500 us
  bool collective_reversed = false;
  double collective_min_us = 1250.0, collective_max_us = 1750.0;
  double collective_low_rad = 0.0, collective_high_rad = 0.0;
  double cyclic_max = 2500.0;
  PulseRangeConfig tail{1100.0, 1500.0, 1900.0};
  double tail_trim_rad = 0.0;
  double throttle_min_us = 1000.0, throttle_max_us = 2000.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HelicopterLinkConfig> auto& c) {
  constexpr std::string_view kPulse = "us";
  v("swashplate", c.swashplate,
    {.choices = {"h3", "h1", "h3_140", "h3_120", "h4_90", "h4_45"}, .meaning = "type of swashplate, H_SW_TYPE"});
  v("h3_azimuths", c.h3_azimuth_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "azimuths of the servos of swashplate h3, H_SW_H3_SVi_POS"});
  v("h3_phase", c.h3_phase_rad,
    {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "phase angle of swashplate h3, H_SW_H3_PHANG"});
  v("trim", c.trim_us,
    {.unit = kPulse,
     .at_least = 500.0,
     .at_most = 2500.0,
     .meaning = "trim of SERVO1, 2, 3 and, with four servos, SERVO5; default 1500 each"});
  v("collective_reversed", c.collective_reversed, {.meaning = "whether H_SW_COL_DIR is 1"});
  v("collective_min", c.collective_min_us,
    {.unit = kPulse, .at_least = 1000.0, .at_most = 2000.0, .meaning = "H_COL_MIN"});
  v("collective_max", c.collective_max_us,
    {.unit = kPulse, .at_least = 1000.0, .at_most = 2000.0, .meaning = "H_COL_MAX"});
  v("collective_low", c.collective_low_rad,
    {.unit = "deg",
     .at_least = -45.0,
     .at_most = 45.0,
     .required = true,
     .meaning = "blade angle of the main rotor at collective_min; linear up to collective_max"});
  v("collective_high", c.collective_high_rad,
    {.unit = "deg",
     .at_least = -45.0,
     .at_most = 45.0,
     .required = true,
     .meaning = "blade angle of the main rotor at collective_max"});
  v("cyclic_max", c.cyclic_max,
    {.above = 0.0, .at_most = 4500.0, .meaning = "H_CYC_MAX, at which the blades reach their cyclic stops"});
  v("tail", c.tail, {.meaning = "pulses of SERVO4"});
  v("tail_trim", c.tail_trim_rad,
    {.unit = "deg",
     .at_least = -45.0,
     .at_most = 45.0,
     .required = true,
     .meaning = "blade angle of the tail rotor at the trim pulse: that of the hover"});
  v("throttle_min", c.throttle_min_us,
    {.unit = kPulse, .at_least = 500.0, .at_most = 2500.0, .meaning = "pulse of SERVO8 at throttle 0"});
  v("throttle_max", c.throttle_max_us,
    {.unit = kPulse, .at_least = 500.0, .at_most = 2500.0, .meaning = "pulse of SERVO8 at throttle 1"});
}

/// Meaning of a multicopter's motor pulses: ArduPilot's FRAME_* and MOT_* parameters.
struct MulticopterLinkConfig {
  int64_t frame_class = 1, frame_type = 1;
  double pwm_min_us = 1000.0, pwm_max_us = 2000.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MulticopterLinkConfig> auto& c) {
  v("frame_class", c.frame_class,
    {.at_least = 0, .at_most = 100, .meaning = "FRAME_CLASS: 1 quad, 2 hexa, 3 octo, 4 octoquad"});
  v("frame_type", c.frame_type, {.at_least = 0, .at_most = 100, .meaning = "FRAME_TYPE: 0 plus, 1 X, ..."});
  v("pwm_min", c.pwm_min_us,
    {.unit = "us", .at_least = 500.0, .at_most = 2500.0, .meaning = "MOT_PWM_MIN: pulse of a motor at rest"});
  v("pwm_max", c.pwm_max_us,
    {.unit = "us", .at_least = 500.0, .at_most = 2500.0, .meaning = "MOT_PWM_MAX: pulse of the maximum rotor speed"});
}

/// ArduPilot with its simulation backend `--model JSON`.
struct ArduPilotLinkConfig {
  static constexpr std::string_view kName = "ardupilot_json";
  static constexpr std::string_view kMeaning = "ArduPilot with --model JSON: Hedgehop is its physics, over UDP";
  std::string host = "127.0.0.1";
  int64_t port = 9002, serial_port = 5760;
  AutopilotStartConfig start;
  int64_t loop_rate_hz = 400;
  MulticopterLinkConfig multicopter;
  std::optional<HelicopterLinkConfig> helicopter;
  std::vector<LinkRangeFinderConfig> range_finders;
  mavlink::CompanionConfig companion;
  double silence_s = 30.0, resend_s = 3.0;  ///< wall times

  int64_t udp_port() const { return port + 10 * start.instance; }
  int64_t tcp_port() const { return serial_port == 0 ? 0 : serial_port + 10 * start.instance; }
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ArduPilotLinkConfig> auto& c) {
  v("port", c.port,
    {.at_least = 1, .at_most = 64000, .meaning = "UDP port of the physics; instance N uses port + 10 N"});
  v("serial_port", c.serial_port,
    {.at_least = 0,
     .at_most = 64000,
     .meaning = "TCP port of the autopilot's first serial line; instance N uses serial_port + 10 N; 0: none"});
  v("host", c.host, {.meaning = "numeric address of the autopilot's serial line"});
  describe(v, c.start);
  v("loop_rate", c.loop_rate_hz,
    {.unit = "Hz", .at_least = 50, .at_most = 2000, .meaning = "SCHED_LOOP_RATE: minimum physics rate"});
  v("multicopter", c.multicopter, {.meaning = "motors of a multicopter"});
  v("helicopter", c.helicopter, {.meaning = "servos of a helicopter; required for helicopters"});
  v("companion", c.companion, {.meaning = "messages to the autopilot over its serial line"});
  v("range_finders", c.range_finders, {.meaning = "up to 6 range finders (RNGFNDi_TYPE 100): true distances"});
  v("silence", c.silence_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "wall time without a new packet after which the flight ends; a repeated packet is not new"});
  v("resend_after", c.resend_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "wall time without a newer packet after which a repeated packet is answered again"});
}

/// Any link. The YAML key `type` selects one.
using LinkConfig = std::variant<ArduPilotLinkConfig, Px4LinkConfig>;
inline const AutopilotStartConfig& start_of(const LinkConfig& link) {
  return std::visit([](const auto& chosen) -> const AutopilotStartConfig& { return chosen.start; }, link);
}

}  // namespace hedgehop::sim
