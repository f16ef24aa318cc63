#include "dynamics/helicopter/rotor_speed.h"

#include <algorithm>

namespace hedgehop::dynamics::helicopter {

double throttle(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state) {
  return std::clamp(engine.proportional_gain_sprad * (set_radps - state.speed_radps) + state.integral_throttle, 0.0,
                    1.0);
}

Eigen::Vector2d derivative(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state,
                           double shaft_power_w) {
  const double open = throttle(engine, set_radps, state);
  const double torque_nm =
      (engine.max_power_w * open - shaft_power_w) / std::max(state.speed_radps, kMinRotorSpeed * set_radps);
  const double speed_error = set_radps - state.speed_radps;
  const bool saturated = (open >= 1.0 && speed_error > 0.0) || (open <= 0.0 && speed_error < 0.0);
  return {torque_nm / engine.inertia_kgm2, saturated ? 0.0 : engine.integral_gain_prad * speed_error};
}

Eigen::Vector2d coasting(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state,
                         double shaft_power_w) {
  const double torque_nm = -shaft_power_w / std::max(state.speed_radps, kMinRotorSpeed * set_radps);
  return {torque_nm / engine.inertia_kgm2, 0.0};
}

}  // namespace hedgehop::dynamics::helicopter
