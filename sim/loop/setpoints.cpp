#include "sim/loop/setpoints.h"

#include <variant>

namespace hedgehop::sim {
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

}  // namespace hedgehop::sim
