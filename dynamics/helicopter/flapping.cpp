#include "dynamics/helicopter/flapping.h"

#include <cmath>

namespace hedgehop::dynamics::helicopter {

FlappingModel at_speed(FlappingModel model, double ratio) {
  model.lag_s /= ratio;
  model.blade_lag_s /= ratio;
  model.bar_lag_s /= ratio;
  model.cross_coupling /= ratio * ratio;
  if (!model.explicit_bar) {
    model.longitudinal_gain *= ratio * ratio;
    model.lateral_gain *= ratio * ratio;
  }
  return model;
}

double speed_flapping(const FlappingModel& model, double collective_rad, double inflow_ratio) {
  return 2.0 * model.speed_gain * (4.0 / 3.0 * collective_rad - inflow_ratio);
}

double heave_flapping(const FlappingModel& model, double advance_ratio) {
  const double mu = advance_ratio;
  return model.speed_gain * 16.0 * mu * mu / ((1.0 - 0.5 * mu * mu) * (8.0 * mu + model.lift_solidity_prad));
}

Eigen::Vector4d derivative(const FlappingModel& m, const FlapState& flap, const FlapInput& in) {
  const double a = flap.back_rad, b = flap.right_rad, c = flap.bar_back_rad, d = flap.bar_right_rad;
  const double mu = Eigen::Vector2d(in.forward_ratio, in.right_ratio).norm();
  const double D_mu = speed_flapping(m, in.collective_rad, in.inflow_ratio);
  const double D_z = heave_flapping(m, mu);
  const double flap_back = D_mu * in.forward_ratio + D_z * in.down_ratio;
  const double flap_right = -D_mu * in.right_ratio;

  // Steady tilt by air, cyclic and bar. The disc lags behind it, and behind the rotation of the shaft.
  double a_goal = flap_back + m.longitudinal_gain * in.longitudinal_rad;
  double b_goal = flap_right + m.lateral_gain * in.lateral_rad;
  Eigen::Vector2d bar_rate = Eigen::Vector2d::Zero();
  if (m.explicit_bar) {
    a_goal += m.mixing * c + m.clockwise * m.cross_coupling * b;
    b_goal += m.mixing * d - m.clockwise * m.cross_coupling * a;
    bar_rate = {(m.bar_longitudinal_gain * in.longitudinal_rad - c) / m.bar_lag_s - in.pitch_radps,
                (m.bar_lateral_gain * in.lateral_rad - d) / m.bar_lag_s - in.roll_radps};
  }
  return {(a_goal - a) / m.lag_s - in.pitch_radps, (b_goal - b) / m.lag_s - in.roll_radps, bar_rate[0], bar_rate[1]};
}

Eigen::Vector2d steady_cyclic(const FlappingModel& m, FlapState& flap, const FlapInput& input) {
  // Rates without cyclic, which the cyclic must cancel through blades and bar.
  FlapState passive{flap.back_rad, flap.right_rad, -m.bar_lag_s * input.pitch_radps, -m.bar_lag_s * input.roll_radps};
  FlapInput hands_off = input;
  hands_off.lateral_rad = hands_off.longitudinal_rad = 0.0;
  const Eigen::Vector4d drift = derivative(m, passive, hands_off);
  const double longitudinal = -drift[0] * m.lag_s / (m.longitudinal_gain + m.mixing * m.bar_longitudinal_gain);
  const double lateral = -drift[1] * m.lag_s / (m.lateral_gain + m.mixing * m.bar_lateral_gain);
  if (m.explicit_bar) {
    flap.bar_back_rad = passive.bar_back_rad + m.bar_longitudinal_gain * longitudinal;
    flap.bar_right_rad = passive.bar_right_rad + m.bar_lateral_gain * lateral;
  }
  return {lateral, longitudinal};
}

}  // namespace hedgehop::dynamics::helicopter
