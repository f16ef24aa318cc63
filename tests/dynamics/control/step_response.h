#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/dynamics/control/closed_loop.h"

/// Response of a vehicle and its autopilot to a step of the commanded velocity, for tests.
namespace hedgehop::dynamics {

/// Properties of a velocity step, in the direction of the step.
struct StepResponse {
  double rise_s = 0.0;       ///< from 10 to 90 %
  double settled_s = 0.0;    ///< time after the step from which it stays within 10 %
  double overshoot = 0.0;    ///< as a share of the step
  double across_mps = 0.0;   ///< maximum velocity normal to the step
  double altitude_m = 0.0;   ///< maximum error
  double heading_rad = 0.0;  ///< maximum error
  double tilt_rad = 0.0;     ///< maximum difference from the hover's roll and pitch
};

inline StepResponse step_response(const Loop& loop, const Eigen::Vector2d& v_WB_W, double duration_s = 6.0) {
  constexpr double kStepAtS = 1.0;
  const std::vector<Sample> flight = fly(loop, kStepAtS + duration_s, [&](double t_s) {
    return control::VelocitySetpoint{t_s < kStepAtS ? Eigen::Vector2d(0.0, 0.0) : v_WB_W, 10.0, loop.heading_rad};
  });
  const double size = v_WB_W.norm();
  const Eigen::Vector2d along = v_WB_W / size, across{-along.y(), along.x()};
  const control::HoverModel hover = control::make_hover_model(loop.vehicle);
  StepResponse r;
  double t10 = 0.0, t90 = 0.0;
  for (const Sample& s : flight) {
    const Eigen::Vector2d v = s.v_WB_W().head<2>();
    const double progress = v.dot(along) / size;
    const double t = s.t_s - kStepAtS;
    if (t10 == 0.0 && progress >= 0.1) t10 = t;
    if (t90 == 0.0 && progress >= 0.9) t90 = t;
    if (std::abs(progress - 1.0) > 0.1) r.settled_s = t;
    r.overshoot = std::max(r.overshoot, progress - 1.0);
    r.across_mps = std::max(r.across_mps, std::abs(v.dot(across)));
    r.altitude_m = std::max(r.altitude_m, std::abs(s.body.p_WB.z() + 10.0));
    const Eigen::Vector3d rpy = s.rpy();
    r.heading_rad = std::max(r.heading_rad, std::abs(wrap_angle(rpy[2] - loop.heading_rad)));
    r.tilt_rad = std::max(r.tilt_rad, std::hypot(rpy[0] - hover.roll_rad, rpy[1] - hover.pitch_rad));
  }
  r.rise_s = t90 > 0.0 ? t90 - t10 : INFINITY;
  return r;
}

}  // namespace hedgehop::dynamics
