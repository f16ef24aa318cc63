#include "sim/scenario/failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "sim/config/config_tree.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using Mode = FailureConfig::Mode;
using dynamics::sensors::Instrument;
using dynamics::sensors::SensorFailure;

struct SensorName {
  std::string_view name;
  Instrument instrument;
  int axes;
  bool may_be_off = true;
};
constexpr std::array kSensors = {
    SensorName{"gyros", Instrument::gyros, 3},
    SensorName{"accelerometers", Instrument::accelerometers, 3},
    SensorName{"gps", Instrument::gps, 3},
    SensorName{"gps_velocity", Instrument::gps_velocity, 3, false},  // a fix has both
    SensorName{"height_sensor", Instrument::height_sensor, 1},
    SensorName{"magnetometer", Instrument::magnetometer, 1},
    SensorName{"barometer", Instrument::barometer, 1},
    SensorName{"range_finder", Instrument::range_finder, 1},
    SensorName{"velocimeter", Instrument::velocimeter, 2},
};
constexpr std::array<std::string_view, 4> kServos = {"servo.collective", "servo.lateral", "servo.longitudinal",
                                                     "servo.tail"};
constexpr std::array<std::string_view, 6> kModes = {"off", "stuck", "bias", "noise", "black", "factor"};
constexpr std::string_view kCamera = "camera.", kMotor = "motor.", kServo = "servo.", kLink = "link";

std::string_view word(Mode mode) { return kModes[static_cast<size_t>(mode)]; }

const SensorName* sensor_of(std::string_view what) {
  const auto* const found = std::ranges::find(kSensors, what, &SensorName::name);
  return found == kSensors.end() ? nullptr : found;
}

/// Returns whether a flight reads the instrument. A failure of any other has no effect.
bool is_on_board(Instrument instrument, const FailingParts& parts) {
  const dynamics::AvionicsConfig& avionics = parts.avionics;
  switch (instrument) {
    case Instrument::gyros:
    case Instrument::accelerometers:
      return true;
    case Instrument::gps:
      return avionics.gps.enabled;
    case Instrument::gps_velocity:
      return avionics.gps.enabled && avionics.navigation.use_gps_velocity;
    case Instrument::height_sensor:
      return avionics.height_sensor.ranger.enabled;
    case Instrument::magnetometer:
      return avionics.magnetometer.enabled;
    case Instrument::barometer:
      return avionics.barometer.enabled;
    case Instrument::range_finder:
      return avionics.range_finder.ranger.enabled;
    case Instrument::velocimeter:
      return parts.velocimeter;
  }
  return true;
}

std::vector<Mode> modes_of(std::string_view what) {
  if (const SensorName* sensor = sensor_of(what)) {
    if (sensor->may_be_off) return {Mode::off, Mode::stuck, Mode::bias, Mode::noise};
    return {Mode::stuck, Mode::bias, Mode::noise};
  }
  if (what.starts_with(kCamera)) return {Mode::off, Mode::stuck, Mode::black};
  if (what.starts_with(kMotor)) return {Mode::off, Mode::stuck, Mode::factor};
  if (what.starts_with(kServo)) return {Mode::stuck, Mode::bias, Mode::factor};
  return {Mode::off, Mode::bias};
}

bool overlap(const FailureConfig& a, const FailureConfig& b) {
  return a.from_ns() < b.until_ns() && b.from_ns() < a.until_ns();
}

int64_t to_ns(double t_s) { return std::llround(t_s * 1e9); }

}  // namespace

int64_t FailureConfig::from_ns() const { return to_ns(at_s); }
int64_t FailureConfig::until_ns() const { return until_s ? to_ns(*until_s) : std::numeric_limits<int64_t>::max(); }

namespace {

/// Whether a vehicle can have a device of this name.
bool is_device(std::string_view name) {
  return sensor_of(name) || name.starts_with(kMotor) || std::ranges::find(kServos, name) != std::end(kServos);
}

}  // namespace

std::vector<std::string> failing_names(const FailingParts& parts) {
  std::vector<std::string> names;
  for (const SensorName& sensor : kSensors) {
    if (is_on_board(sensor.instrument, parts)) names.emplace_back(sensor.name);
  }
  for (const CameraConfig& camera : parts.rig.cameras) names.push_back(fmt::format("{}{}", kCamera, camera.role));
  if (const auto* multicopter = std::get_if<dynamics::multicopter::MulticopterConfig>(&parts.vehicle)) {
    for (size_t i = 0; i < multicopter->arms.size(); ++i) names.push_back(fmt::format("{}{}", kMotor, i));
  } else {
    names.insert(names.end(), kServos.begin(), kServos.end());
  }
  names.emplace_back(kLink);
  return names;
}

std::vector<FieldError> failure_errors(std::span<const FailureConfig> failures, double duration_s,
                                       const FailingParts& parts) {
  std::vector<FieldError> errors;
  const std::vector<std::string> names = failing_names(parts);
  const std::vector<std::string_view> allowed(names.begin(), names.end());
  for (size_t i = 0; i < failures.size(); ++i) {
    const FailureConfig& f = failures[i];
    const auto add = [&](std::string_view key, std::string message) {
      errors.push_back({fmt::format("failures.{}.{}", i, key), std::move(message)});
    };
    if (f.at_s >= duration_s) add("at", fmt::format("must be before the end of the flight ({} s)", duration_s));
    if (f.until_s && *f.until_s <= f.at_s) add("until", fmt::format("must be greater than 'at' ({} s)", f.at_s));
    if (f.until_s && *f.until_s > duration_s)
      add("until", fmt::format("is after the end of the flight ({} s)", duration_s));
    if (std::ranges::find(names, f.what) == names.end()) {
      const std::string fault = is_device(f.what) ? "'{}' is not on board or is not used" : "unknown device '{}'";
      add("what", fmt::format(fmt::runtime(fault + "{}"), f.what, suggestion(f.what, allowed)));
      continue;
    }
    const std::vector<Mode> modes = modes_of(f.what);
    if (std::ranges::find(modes, f.mode) == modes.end()) {
      std::vector<std::string_view> words;
      for (const Mode mode : modes) words.push_back(word(mode));
      add("mode", fmt::format("is not for {}; allowed: {}", f.what, fmt::join(words, ", ")));
      continue;
    }
    const bool needs_value = f.mode == Mode::bias || f.mode == Mode::noise || f.mode == Mode::factor;
    const bool may_be_negative = f.mode == Mode::bias && f.what != kLink;
    if (needs_value && !f.value) add("mode", fmt::format("{} needs a 'value'", word(f.mode)));
    if (!needs_value && f.value) add("value", fmt::format("is not for mode {}", word(f.mode)));
    if (f.value && *f.value < 0.0 && !may_be_negative)
      add("value", fmt::format("must be at least 0, got {}", *f.value));
    const SensorName* const sensor = sensor_of(f.what);
    const int axes = sensor && f.mode == Mode::bias ? sensor->axes : 1;
    if (static_cast<int>(f.axis) >= axes) {
      constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
      add("axis", fmt::format("'{}' is not an axis of {} {}; valid: {}", kAxes[static_cast<size_t>(f.axis)], f.what,
                              word(f.mode), fmt::join(kAxes.begin(), kAxes.begin() + axes, ", ")));
    }
    for (size_t j = 0; j < i; ++j) {
      if (failures[j].what == f.what && overlap(failures[j], f)) {
        add("at", fmt::format("{} fails already then, by failure {}", f.what, j));
        break;
      }
    }
  }
  return errors;
}

std::string to_text(const FailureConfig& f) {
  const std::string until = f.until_s ? fmt::format(" to {} s", *f.until_s) : " to the end";
  const std::string value = f.value ? fmt::format(" {}", *f.value) : "";
  return fmt::format("{} s{}: {} {}{}", f.at_s, until, f.what, word(f.mode), value);
}

std::vector<SensorFailure> sensor_failures(std::span<const FailureConfig> failures, uint64_t run_seed) {
  std::vector<SensorFailure> list;
  for (size_t i = 0; i < failures.size(); ++i) {
    const FailureConfig& f = failures[i];
    const SensorName* const sensor = sensor_of(f.what);
    if (!sensor) continue;
    const double unit = sensor->instrument == Instrument::magnetometer ? std::numbers::pi / 180.0 : 1.0;
    list.push_back({.instrument = sensor->instrument,
                    .mode = static_cast<SensorFailure::Mode>(f.mode),  // its first four are the sensors'
                    .from_ns = f.from_ns(),
                    .until_ns = f.until_ns(),
                    .value = unit * f.value.value_or(0.0),
                    .axis = static_cast<int>(f.axis),
                    .seed = stream_seed(run_seed, fmt::format("failure.{}.{}", i, f.what))});
    if (sensor->instrument == Instrument::gps && f.mode == Mode::stuck) {  // the whole fix
      list.push_back(list.back());
      list.back().instrument = Instrument::gps_velocity;
    }
  }
  return list;
}

void actuator_faults(std::span<const FailureConfig> failures, int64_t t_ns, std::vector<dynamics::ActuatorFault>& out) {
  using Kind = dynamics::ActuatorFault::Kind;
  out.clear();
  for (const FailureConfig& f : failures) {
    const std::string_view what = f.what;
    const bool is_motor = what.starts_with(kMotor), is_servo = what.starts_with(kServo);
    if ((!is_motor && !is_servo) || !f.holds(t_ns)) continue;
    const size_t index = is_motor ? std::stoul(f.what.substr(kMotor.size()))
                                  : static_cast<size_t>(std::ranges::find(kServos, what) - kServos.begin());
    const double value = f.value.value_or(0.0);
    switch (f.mode) {
      case Mode::stuck:
        out.push_back({index, Kind::stuck, 0.0});
        break;
      case Mode::bias:
        out.push_back({index, Kind::offset, value * std::numbers::pi / 180.0});
        break;
      default:  // off is factor 0
        out.push_back({index, Kind::scaled, value});
    }
  }
}

const FailureConfig* failure_of(std::span<const FailureConfig> failures, std::string_view what, int64_t t_ns) {
  for (const FailureConfig& failure : failures) {
    if (failure.what == what && failure.holds(t_ns)) return &failure;
  }
  return nullptr;
}

}  // namespace hedgehop::sim
