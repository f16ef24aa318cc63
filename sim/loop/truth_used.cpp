#include "sim/loop/truth_used.h"

#include <fmt/format.h>

#include <string_view>

namespace hedgehop::sim {
namespace {

using namespace dynamics::sensors;

/// What of the truth a channel holds; empty for images.
std::string_view truth_in(avoidance::CameraNeed::Channel channel) {
  using Channel = avoidance::CameraNeed::Channel;
  if (channel == Channel::corners) return "projected corners";
  return channel == Channel::depth ? "depth" : "";
}

bool is_exact(const RangerConfig& c) {
  return c.enabled && c.noise_m == 0.0 && c.noise_per_range == 0.0 && c.offset_m == 0.0;
}
bool is_exact(const MagnetometerConfig& c) { return c.enabled && c.noise_rad == 0.0 && c.offset_rad == 0.0; }
bool is_exact(const BarometerConfig& c) { return c.enabled && c.noise_pa == 0.0 && c.wander_pa == 0.0; }
bool has_exact_gyros(const ImuConfig& c) {
  return c.gyro_noise_density == 0.0 && c.gyro_bias_walk == 0.0 && c.gyro_offset_radps == 0.0 &&
         c.misalignment_rad == 0.0;
}
bool has_exact_accelerometers(const ImuConfig& c) {
  return c.accelerometer_noise_density == 0.0 && c.accelerometer_bias_walk == 0.0 &&
         c.accelerometer_offset_mps2 == 0.0 && c.misalignment_rad == 0.0;
}
bool has_exact_position(const GpsConfig& c) {
  return c.enabled && c.noise_m == 0.0 && c.wander_horizontal_m == 0.0 && c.wander_vertical_m == 0.0;
}
bool has_exact_velocity(const GpsConfig& c) { return c.enabled && c.velocity_noise_mps == 0.0; }

/// Of an instrument that measures two things: "exact", or which of them is; empty for neither.
std::string of_two(bool first_is_exact, std::string_view first, bool second_is_exact, std::string_view second) {
  if (first_is_exact && second_is_exact) return "exact";
  if (!first_is_exact && !second_is_exact) return "";
  return fmt::format("exact {}", first_is_exact ? first : second);
}
std::string words(bool exact) { return exact ? "exact" : ""; }

}  // namespace

std::vector<std::string> truth_used(const avoidance::Needs& needs, const dynamics::AvionicsConfig& avionics) {
  std::vector<std::string> list;
  const auto add = [&](std::string_view kind, std::string_view name, std::string_view truth) {
    if (!truth.empty()) list.push_back(fmt::format("{} '{}': {}", kind, name, truth));
  };
  for (const avoidance::CameraNeed& need : needs.cameras) add("camera", need.role, truth_in(need.channel));
  const dynamics::AvionicsConfig& c = avionics;
  add("sensor", "imu", of_two(has_exact_gyros(c.imu), "gyros", has_exact_accelerometers(c.imu), "accelerometers"));
  add("sensor", "gps", of_two(has_exact_position(c.gps), "position", has_exact_velocity(c.gps), "velocity"));
  add("sensor", "height_sensor", words(is_exact(c.height_sensor.ranger)));
  add("sensor", "magnetometer", words(is_exact(c.magnetometer)));
  add("sensor", "barometer", words(is_exact(c.barometer)));
  add("sensor", "range_finder", words(is_exact(c.range_finder.ranger)));
  return list;
}

}  // namespace hedgehop::sim
