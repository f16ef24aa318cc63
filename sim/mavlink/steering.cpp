#include "sim/mavlink/steering.h"

#include <algorithm>
#include <stdexcept>
#include <variant>

namespace hedgehop::sim::mavlink {
namespace {

// POSITION_TARGET_TYPEMASK: a bit per ignored field.
constexpr uint16_t kIgnorePosition = 1 | 2 | 4, kIgnoreVelocity = 8 | 16 | 32, kIgnoreAcceleration = 64 | 128 | 256,
                   kIgnoreYaw = 1024, kIgnoreYawRate = 2048;
constexpr uint8_t kLocalNed = 1;  // MAV_FRAME
constexpr double kAltitudeTimeS = 1.0, kMaxClimbMps = 2.0;

struct SetpointOf {
  const avoidance::NavigationState& navigation;
  const Eigen::Vector3d& p_origin_W;

  SetPositionTargetLocalNed operator()(const avoidance::VelocityCommand& command) const {
    const double altitude_est_m = -navigation.p_WB_est.z();
    const double climb_mps =
        std::clamp((command.altitude_m - altitude_est_m) / kAltitudeTimeS, -kMaxClimbMps, kMaxClimbMps);
    return {.vx = static_cast<float>(command.v_WB_W.x()),
            .vy = static_cast<float>(command.v_WB_W.y()),
            .vz = static_cast<float>(-climb_mps),
            .yaw = static_cast<float>(command.heading_rad),
            .type_mask = kIgnorePosition | kIgnoreAcceleration | kIgnoreYawRate,
            .coordinate_frame = kLocalNed};
  }
  SetPositionTargetLocalNed operator()(const avoidance::PositionCommand& command) const {
    const Eigen::Vector3f p = (command.p_WB - p_origin_W).cast<float>();
    return {.x = p.x(),
            .y = p.y(),
            .z = p.z(),
            .yaw = static_cast<float>(command.heading_rad),
            .type_mask = kIgnoreVelocity | kIgnoreAcceleration | kIgnoreYawRate,
            .coordinate_frame = kLocalNed};
  }
  SetPositionTargetLocalNed operator()(const avoidance::HoverCommand& command) const {
    return {.yaw_rate = static_cast<float>(command.yaw_rate_radps),
            .type_mask = kIgnorePosition | kIgnoreAcceleration | kIgnoreYaw,
            .coordinate_frame = kLocalNed};
  }
  SetPositionTargetLocalNed operator()(const avoidance::AttitudeCommand&) const { return {}; }  // refused before
};

struct SameCommand {
  bool operator()(const avoidance::VelocityCommand& a, const avoidance::VelocityCommand& b) const {
    return a.v_WB_W == b.v_WB_W && a.altitude_m == b.altitude_m && a.heading_rad == b.heading_rad;
  }
  bool operator()(const avoidance::PositionCommand& a, const avoidance::PositionCommand& b) const {
    return a.p_WB == b.p_WB && a.heading_rad == b.heading_rad;
  }
  bool operator()(const avoidance::HoverCommand& a, const avoidance::HoverCommand& b) const {
    return a.yaw_rate_radps == b.yaw_rate_radps;
  }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

}  // namespace

void require_steerable(const avoidance::Needs& needs) {
  if (std::ranges::count(needs.commands, avoidance::CommandType::attitude) > 0) {
    throw std::invalid_argument(
        "the module commands attitudes, which autopilots do not accept; valid: modules that command velocities and "
        "positions");
  }
}

void require_steerable(const avoidance::Command& command) {
  if (!std::holds_alternative<avoidance::AttitudeCommand>(command)) return;
  throw std::invalid_argument("link: AttitudeCommand cannot be sent to this autopilot");
}

SetPositionTargetLocalNed to_setpoint(const avoidance::Command& command, const avoidance::NavigationState& navigation,
                                      const Eigen::Vector3d& p_origin_W) {
  require_steerable(command);
  return std::visit(SetpointOf{navigation, p_origin_W}, command);
}

void Steering::send(int64_t t_ns, const avoidance::Command& command, const avoidance::NavigationState& navigation,
                    FrameWriter& writer, std::vector<uint8_t>& bytes) {
  if (last_ && t_ns - sent_ns_ < kRepeatNs && std::visit(SameCommand{}, *last_, command)) return;
  SetPositionTargetLocalNed setpoint = to_setpoint(command, navigation, p_origin_W_);
  setpoint.time_boot_ms = static_cast<uint32_t>(t_ns / 1'000'000);
  setpoint.target_system = autopilot_.system;
  setpoint.target_component = autopilot_.component;
  writer.append(setpoint, bytes);
  last_ = command;
  sent_ns_ = t_ns;
}

}  // namespace hedgehop::sim::mavlink
