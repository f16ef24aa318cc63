#include "sim/loop/module_pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string_view>
#include <utility>
#include <variant>

#include "avoidance/blind_stop.h"
#include "sim/config/input_error.h"
#include "sim/fields/quantities.h"
#include "sim/loop/active_module.h"
#include "sim/plugin/foreign_module.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

void require_cameras(const RigConfig& rig, const avoidance::Needs& needs) {
  std::vector<FieldError> errors;
  for (const avoidance::CameraNeed& need : needs.cameras) {
    for (const std::string& message : rig.lacks(need.role, need.channel, need.pinhole)) {
      errors.push_back({"avoidance", message});
    }
  }
  if (!errors.empty()) throw InputError(std::move(errors));
}

}  // namespace

ModulePilot::ModulePilot(const Scenario& scenario, const Ticks& ticks, Cameras& cameras,
                         std::unique_ptr<avoidance::Module> module, const std::filesystem::path& module_folder)
    : scenario_(scenario),
      ticks_(ticks),
      cameras_(cameras),
      module_(make_active_module(scenario, ticks, std::move(module), module_folder)),
      truth_used_(sim::truth_used(module_->needs(), scenario.avionics)),
      route_(scenario) {
  require_cameras(scenario.rig, module_->needs());
  int64_t slowest = 0;
  for (const avoidance::CameraNeed& need : module_->needs().cameras) {
    module_cameras_.push_back(cameras_.index(need.role));
    slowest = std::max(slowest, cameras_.period_ticks(module_cameras_.back()));
  }
  // A module without cameras decides as often as the rig's fastest camera, so that a control flight is comparable.
  decision_period_ = ticks_.period(static_cast<double>(scenario.control_rate_hz));
  for (size_t i = 0; i < cameras_.count(); ++i) {
    decision_period_ = i == 0 ? cameras_.period_ticks(i) : std::min(decision_period_, cameras_.period_ticks(i));
  }
  for (const size_t camera : module_cameras_) {
    const int64_t blind_ns = avoidance::blind_after_ns(cameras_.mounted(camera).rate_hz);
    blind_after_ = std::max(blind_after_, ticks_.ticks(seconds(blind_ns)));
  }
  first_decision_ = last_seen_ = ticks_.ticks(scenario.start.hold_s);
  latency_ =
      scenario.command_latency_s ? ticks_.ticks(*scenario.command_latency_s) : std::max(slowest, decision_period_);
}

void ModulePilot::reset(const std::vector<dynamics::HullPart>& hull, const dynamics::control::Setpoint& hold) {
  steering_ = hold;
  try {
    module_->reset(module_setup(scenario_, hull));
  } catch (const std::exception& fault) {
    throw InputError(FieldError{"avoidance", fmt::format("the module cannot be reset: {}", fault.what())});
  }
}

bool ModulePilot::exposes(int64_t tick) const {
  return std::ranges::any_of(module_cameras_, [&](size_t camera) { return cameras_.due(camera, tick); });
}

void ModulePilot::expose(int64_t tick, const BodyMotion& body) {
  seen_.clear();
  exposed_ = false;
  for (const size_t camera : module_cameras_) {
    if (!cameras_.due(camera, tick)) continue;
    // Also during the hold, in which a camera adapts its gain. Else an export, which exposes it, would change the
    // flight.
    const avoidance::CameraFrame* const frame = cameras_.expose(camera, ticks_.t_ns(tick), body);
    if (tick < first_decision_) continue;
    exposed_ = true;
    if (frame) {
      seen_.push_back(*frame);
      last_seen_ = tick;
    }
  }
}

bool ModulePilot::decides(int64_t tick) const {
  if (module_cameras_.empty()) return tick >= first_decision_ && tick % decision_period_ == 0;
  return !seen_.empty() || (exposed_ && tick - last_seen_ > blind_after_);
}

avoidance::Observation ModulePilot::observe(int64_t tick, const avoidance::NavigationState& navigation) {
  route_.update(navigation.p_WB_est);
  return {ticks_.t_ns(tick), seen_, navigation, route_.goal()};
}

avoidance::Decision ModulePilot::decide(int64_t tick, const avoidance::Observation& observation) {
  avoidance::Decision decision = module_->update(observation);
  queue_command(tick, decision.command);
  return decision;
}

avoidance::Command ModulePilot::override_decision(int64_t tick, avoidance::Command command) {
  avoidance::confine(command, scenario_.avionics.autopilot.speed_limit_mps);
  queue_command(tick, command);
  return command;
}

void ModulePilot::override_decision(int64_t tick, const DirectCommand& command) {
  require_valid(command, scenario_.vehicle);
  queue_command(tick, command);
}

/// Sends a command over the link, which keeps the order.
void ModulePilot::queue_command(int64_t tick, CallerCommand command) {
  int64_t latency = latency_;
  if (const FailureConfig* failure = failure_of(scenario_.failures, "link", ticks_.t_ns(tick))) {
    if (failure->mode == FailureConfig::Mode::off) return;
    latency += ticks_.ticks(failure->value.value_or(0.0));
  }
  pending_.push_back({tick + latency, std::move(command)});
}

const Steering& ModulePilot::steering(int64_t tick) {
  while (!pending_.empty() && pending_.front().tick <= tick) {
    const CallerCommand& command = pending_.front().command;
    if (const auto* const direct = std::get_if<DirectCommand>(&command)) {
      steering_ = *direct;
    } else {
      command_ = std::get<avoidance::Command>(command);
      steering_ = to_setpoint(*command_);
    }
    pending_.pop_front();
  }
  return steering_;
}

bool ModulePilot::sees_through_walls() const {
  const std::vector<avoidance::CameraNeed> cameras = module_->needs().cameras;
  return !cameras.empty() && cameras.front().channel == avoidance::CameraNeed::Channel::corners;
}

std::optional<size_t> ModulePilot::first_camera() const {
  return module_cameras_.empty() ? std::nullopt : std::optional(module_cameras_.front());
}

namespace {

dynamics::control::Setpoint convert(const avoidance::VelocityCommand& c) {
  return dynamics::control::VelocitySetpoint{c.v_WB_W, c.altitude_m, c.heading_rad};
}
dynamics::control::Setpoint convert(const avoidance::PositionCommand& c) {
  return dynamics::control::PositionSetpoint{c.p_WB, c.heading_rad};
}
dynamics::control::Setpoint convert(const avoidance::AttitudeCommand& c) {
  return dynamics::control::AttitudeSetpoint{c.roll_rad, c.pitch_rad, c.heading_rad, c.altitude_m};
}
dynamics::control::Setpoint convert(const avoidance::HoverCommand& c) {
  return dynamics::control::HoverSetpoint{c.yaw_rate_radps};
}

}  // namespace

dynamics::control::Setpoint to_setpoint(const avoidance::Command& command) {
  return std::visit([](const auto& c) { return convert(c); }, command);
}

avoidance::NavigationState to_navigation_state(const dynamics::Avionics& avionics) {
  const dynamics::control::NavigationEstimate& estimate = avionics.navigation();
  return {estimate.p_WB_est,   estimate.q_WB_est,  estimate.v_WB_B_est,
          estimate.w_WB_B_est, estimate.q_WB_gyro, estimate.height_above_ground_m,
          avionics.range_m()};
}

namespace {

using namespace dynamics::sensors;

/// Returns the ground truth in a channel; empty for images.
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

/// Returns "exact" for an instrument with two exact quantities, or the exact one; empty for neither.
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
