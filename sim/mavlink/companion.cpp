#include "sim/mavlink/companion.h"

#include <utility>

#include "sim/mavlink/command_messages.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr Sender kIdentity{1, 196};  // MAV_COMP_ID_OBSTACLE_AVOIDANCE of the vehicle
constexpr uint8_t kOnboardController = 18, kNoAutopilot = 8, kActive = 4;
constexpr int64_t kHeartbeatNs = 1'000'000'000;

std::variant<ArduPilotStart, Px4Start> start_of(const CompanionSetup& setup) {
  const StartPose start{setup.p_start_W - setup.p_origin_W, setup.start_heading_rad};
  if (setup.make == AutopilotMake::px4) return Px4Start(start);
  return ArduPilotStart(start, setup.has_interlock);
}

}  // namespace

Companion::Companion(const CompanionConfig& config, CompanionSetup setup)
    : config_(config),
      setup_(std::move(setup)),
      writer_(kIdentity),
      autopilot_(setup_.make),
      perception_(config.perception, setup_.needs, setup_.module, setup_.p_origin_W, setup_.make),
      start_(start_of(setup_)) {
  if (config.steer) require_steerable(setup_.needs);
}

void Companion::receive(std::span<const uint8_t> bytes) {
  for (const Frame& frame : decoder_.decode(bytes)) autopilot_.take(frame);
}

void Companion::observe(int64_t t_ns, const avoidance::Observation& observation) {
  perception_.observe(t_ns, observation);
}

void Companion::send(int64_t t_ns, const avoidance::NavigationState* navigation, const avoidance::Command* command,
                     std::vector<uint8_t>& bytes) {
  if (!heartbeat_ns_ || t_ns - *heartbeat_ns_ >= kHeartbeatNs) {
    heartbeat_ns_ = t_ns;
    writer_.append(Heartbeat{.type = kOnboardController, .autopilot = kNoAutopilot, .system_status = kActive}, bytes);
  }
  if (config_.steer && command) require_steerable(*command);
  if (!autopilot_.sender()) return;
  perception_.send(t_ns, navigation, writer_, bytes);
  if (!config_.steer) return;
  if (!command || !navigation) {
    std::visit([&](auto& start) { start.send(t_ns, autopilot_, writer_, bytes); }, start_);
    return;
  }
  if (!steering_) steering_.emplace(*autopilot_.sender(), setup_.p_origin_W);
  steering_->send(t_ns, *command, *navigation, writer_, bytes);
}

std::string Companion::awaited() const {
  if (!config_.steer) return "";
  return std::visit([&](const auto& start) { return mavlink::awaited(start.step(), autopilot_); }, start_);
}

std::string Companion::fault() const {
  if (!autopilot_.fault().empty()) return autopilot_.fault();
  return !autopilot_.sender() && counts().version_1 > 0 ? "MAVLink 1; valid: MAVLink 2" : "";
}

}  // namespace hedgehop::sim::mavlink
