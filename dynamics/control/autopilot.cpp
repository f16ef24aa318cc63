#include "dynamics/control/autopilot.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <variant>

#include "dynamics/rigid_body.h"
#include "dynamics/sensors/magnetometer.h"
#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kUsualDtS = 0.01;
constexpr int kIntegrals = 4;
constexpr int kIntegrated[kIntegrals] = {HoverModel::kForward, HoverModel::kRight, HoverModel::kBelow,
                                         HoverModel::kHeading};

/// Deviations of equal cost in a design; the weights are their inverse squares.
struct Acceptable {
  double velocity_mps, climb_mps, tilt_rad, heading_rad, rate_radps, below_m;
};
// Chosen so that the reference flight reaches a speed within about one second without overshoot, the vehicle follows it
// about as stiffly, and the heading holds in a side wind on the tail rotor.
constexpr Acceptable kPlan{
    .velocity_mps = 0.4, .climb_mps = 0.5, .tilt_rad = 0.3, .heading_rad = 0.05, .rate_radps = 1.0, .below_m = 0.25};
constexpr Acceptable kHold{
    .velocity_mps = 0.25, .climb_mps = 0.5, .tilt_rad = 0.3, .heading_rad = 0.05, .rate_radps = 1.0, .below_m = 0.15};
const Eigen::Vector4d kAcceptableIntegrals{0.4, 0.4, 0.2, 0.2};  // m, m, m s, rad s

double weight(double acceptable) { return 1.0 / (acceptable * acceptable); }

DesignMatrix state_weights(const Acceptable& a, Eigen::Index size) {
  DesignVector q = DesignVector::Zero(size);
  q[HoverModel::kForward] = q[HoverModel::kRight] = weight(a.velocity_mps);
  q[HoverModel::kDown] = weight(a.climb_mps);
  q[HoverModel::kRollAngle] = q[HoverModel::kPitchAngle] = weight(a.tilt_rad);
  q[HoverModel::kHeading] = weight(a.heading_rad);
  q.segment<3>(HoverModel::kP).setConstant(weight(a.rate_radps));
  q[HoverModel::kBelow] = weight(a.below_m);
  return q.asDiagonal();
}

DesignMatrix input_weights(const Controls& acceptable) {
  return DesignVector(acceptable.array().square().inverse()).asDiagonal();
}

Eigen::Vector2d clamp_norm(const Eigen::Vector2d& v, double max_norm) {
  const double length = v.norm();
  return length > max_norm ? Eigen::Vector2d(v * (max_norm / length)) : v;
}

Eigen::Vector2d rotate(double angle_rad, const Eigen::Vector2d& v) { return Eigen::Rotation2Dd(angle_rad) * v; }

}  // namespace

Autopilot::Autopilot(const AutopilotConfig& config, const VehicleConfig& vehicle)
    : config_(fields::require_bounds(config, "autopilot")), model_(make_hover_model(vehicle)) {
  design(kUsualDtS);
  reset({});
}

void Autopilot::design(double dt_s) {
  dt_s_ = dt_s;
  const Eigen::Index n = model_.motion.A.rows();
  step_ = sampled(model_.motion, dt_s);
  K_plan_ = lqr_gain(step_, state_weights(kPlan, n), input_weights(model_.acceptable));

  LinearSystem augmented{DesignMatrix::Zero(n + kIntegrals, n + kIntegrals),
                         DesignMatrix::Zero(n + kIntegrals, kControlAxes)};
  augmented.A.topLeftCorner(n, n) = model_.motion.A;
  augmented.B.topRows(n) = model_.motion.B;
  for (int i = 0; i < kIntegrals; ++i) augmented.A(n + i, kIntegrated[i]) = 1.0;
  DesignMatrix Q = state_weights(kHold, n + kIntegrals);
  for (int i = 0; i < kIntegrals; ++i) Q(n + i, n + i) = weight(kAcceptableIntegrals[i]);
  K_hold_ = lqr_gain(sampled(augmented, dt_s), Q, input_weights(model_.acceptable));

  solve_cruise();
  plan_slopes_ = slopes(K_plan_);
  hold_slopes_ = slopes(K_hold_);
}

/// Solves for the attitude, hidden states and controls of the model's steady flight, per velocity.
void Autopilot::solve_cruise() {
  const DesignMatrix& A = model_.motion.A;
  const Eigen::Index n = A.rows(), hidden = n - HoverModel::kHidden;
  // Unknown: roll and pitch, the hidden states, the controls. The altitude error drops out.
  Eigen::MatrixXd unknown(n, 2 + hidden + kControlAxes);
  unknown << A.middleCols(HoverModel::kRollAngle, 2), A.rightCols(hidden), model_.motion.B;
  const Eigen::MatrixXd found = unknown.completeOrthogonalDecomposition().solve(-A.leftCols(2));
  cruise_state_ = DesignMatrix::Zero(n, 2);
  cruise_state_.topRows(2).setIdentity();
  cruise_state_.middleRows(HoverModel::kRollAngle, 2) = found.topRows(2);
  cruise_state_.bottomRows(hidden) = found.middleRows(2, hidden);
  cruise_controls_ = found.bottomRows(kControlAxes);
}

Autopilot::Slopes Autopilot::slopes(const DesignMatrix& K) const {
  const Eigen::Index n = model_.motion.A.rows();
  Slopes s;
  s.tilt_per_mps << K(kPitch, HoverModel::kForward) / K(kPitch, HoverModel::kPitchAngle),
      K(kRoll, HoverModel::kRight) / K(kRoll, HoverModel::kRollAngle);
  s.tilt_per_m.setZero();
  if (K.cols() > n) {
    s.tilt_per_m << K(kPitch, n) / K(kPitch, HoverModel::kPitchAngle),
        K(kRoll, n + 1) / K(kRoll, HoverModel::kRollAngle);
  }
  s.climb_per_m = K(kHeave, HoverModel::kBelow) / K(kHeave, HoverModel::kDown);
  s.turn_per_rad = K(kYaw, HoverModel::kHeading) / K(kYaw, HoverModel::kR);
  return s;
}

void Autopilot::reset(const NavigationEstimate& now) {
  const Eigen::Index n = model_.motion.A.rows();
  reference_ = DesignVector::Zero(n);
  reference_[HoverModel::kHeading] = to_roll_pitch_heading(now.q_WB_est)[2];
  reference_[HoverModel::kBelow] = now.p_WB_est.z();
  hidden_ = DesignVector::Zero(n - HoverModel::kHidden);
  integrals_.setZero();
  anchor_.reset();
}

Autopilot::Target Autopilot::target(const VelocitySetpoint& s, const NavigationEstimate&) {
  return {.v_WB_W = clamp_norm(s.v_WB_W, config_.speed_limit_mps),
          .altitude_m = s.altitude_m,
          .heading_rad = s.heading_rad};
}

Autopilot::Target Autopilot::target(const PositionSetpoint& s, const NavigationEstimate& now) {
  return {.v_WB_W = velocity_towards(s.p_WB.head<2>(), now.p_WB_est.head<2>()),
          .altitude_m = -s.p_WB.z(),
          .heading_rad = s.heading_rad};
}

Autopilot::Target Autopilot::target(const AttitudeSetpoint& s, const NavigationEstimate&) {
  const Eigen::Vector2d tilt = clamp_norm({s.pitch_rad, s.roll_rad}, config_.tilt_limit_rad);
  return {.altitude_m = s.altitude_m,
          .heading_rad = s.heading_rad,
          .attitude = true,
          .roll_rad = tilt[1],
          .pitch_rad = tilt[0]};
}

Autopilot::Target Autopilot::target(const HoverSetpoint& s, const NavigationEstimate& now) {
  constexpr double kStoppedMps = 0.2;
  if (!anchor_)
    anchor_ =
        HoverAnchor{-reference_[HoverModel::kBelow], reference_[HoverModel::kHeading], false, Eigen::Vector2d::Zero()};
  if (!anchor_->stopped && (now.q_WB_est * now.v_WB_B_est).head<2>().norm() < kStoppedMps) {
    anchor_->stopped = true;
    anchor_->p_WB = now.p_WB_est.head<2>();
  }
  const double turn = std::clamp(s.yaw_rate_radps, -config_.yaw_rate_limit_radps, config_.yaw_rate_limit_radps);
  anchor_->heading_rad = wrap_angle(anchor_->heading_rad + turn * dt_s_);
  Target out{.altitude_m = anchor_->altitude_m, .heading_rad = anchor_->heading_rad};
  if (anchor_->stopped) out.v_WB_W = velocity_towards(anchor_->p_WB, now.p_WB_est.head<2>());
  return out;
}

/// Returns a velocity towards a point, so that half the maximum acceleration stops the vehicle there.
Eigen::Vector2d Autopilot::velocity_towards(const Eigen::Vector2d& p_WG, const Eigen::Vector2d& p_WB) const {
  constexpr double kSeparation = 4.0;  // bandwidth of velocity over that of position
  const double velocity_bandwidth = kGravityMps2 * plan_slopes_.tilt_per_mps.cwiseAbs().minCoeff();
  const Eigen::Vector2d way = p_WG - p_WB;
  const double distance_m = way.norm();
  const double speed_mps = std::min({config_.speed_limit_mps, velocity_bandwidth / kSeparation * distance_m,
                                     std::sqrt(config_.acceleration_limit_mps2 * distance_m)});
  return distance_m > 0.0 ? Eigen::Vector2d(way * (speed_mps / distance_m)) : Eigen::Vector2d::Zero();
}

Controls Autopilot::control(const Setpoint& setpoint, const NavigationEstimate& now, double dt_s) {
  if (dt_s != dt_s_) design(dt_s);
  if (!std::holds_alternative<HoverSetpoint>(setpoint)) anchor_.reset();
  const Target target = std::visit([&](const auto& s) { return this->target(s, now); }, setpoint);

  DesignVector state = state_of(now);
  if (target.attitude) reference_.head<2>() = state.head<2>();  // no velocity to follow
  const Controls planned = plan(target);
  const Controls wanted = model_.trim + planned + hold(state, planned, target.attitude);
  const Controls given = wanted.cwiseMax(model_.lowest).cwiseMin(model_.highest);

  hidden_ =
      (step_.A.bottomRows(hidden_.size()) * state + step_.B.bottomRows(hidden_.size()) * (given - model_.trim)).eval();
  advance_reference(planned);
  return given;
}

/// Returns the model's state: the estimate, with velocities in the frame of the estimated heading, and the predicted
/// hidden states.
DesignVector Autopilot::state_of(const NavigationEstimate& now) const {
  const Eigen::Vector3d rpy = to_roll_pitch_heading(now.q_WB_est);
  const Eigen::Vector3d v_WB_W = now.q_WB_est * now.v_WB_B_est;
  DesignVector x(reference_.size());
  x << rotate(-rpy[2], v_WB_W.head<2>()), v_WB_W.z(), rpy[0] - model_.roll_rad, rpy[1] - model_.pitch_rad, rpy[2],
      now.w_WB_B_est, now.p_WB_est.z(), hidden_;
  return x;
}

/// Returns the controls of the reference flight for a target. Errors are clamped so that the design stays within the
/// limits.
Controls Autopilot::plan(const Target& target) const {
  const AutopilotConfig& c = config_;
  DesignVector e = reference_;
  Controls cruise = Controls::Zero();
  if (target.attitude) {
    e.head<2>().setZero();
    e[HoverModel::kRollAngle] -= target.roll_rad;
    e[HoverModel::kPitchAngle] -= target.pitch_rad;
  } else {
    const Eigen::Vector2d v_H = rotate(-reference_[HoverModel::kHeading], target.v_WB_W);
    const Eigen::Vector2d error = e.head<2>() - v_H;
    e -= cruise_state_ * v_H;
    cruise = cruise_controls_ * v_H;
    const Eigen::Vector2d tilt = plan_slopes_.tilt_per_mps.cwiseProduct(error);
    e.head<2>() = clamp_norm(tilt, c.acceleration_limit_mps2 / kGravityMps2).cwiseQuotient(plan_slopes_.tilt_per_mps);
  }
  const double below_m = c.climb_rate_limit_mps / plan_slopes_.climb_per_m;
  e[HoverModel::kBelow] = std::clamp(reference_[HoverModel::kBelow] + target.altitude_m, -below_m, below_m);
  const double max_error_rad = c.yaw_rate_limit_radps / plan_slopes_.turn_per_rad;
  e[HoverModel::kHeading] =
      std::clamp(wrap_angle(reference_[HoverModel::kHeading] - target.heading_rad), -max_error_rad, max_error_rad);
  return cruise - K_plan_ * e;
}

/// Returns the controls that hold the vehicle to the reference flight, and advances the integrals.
Controls Autopilot::hold(const DesignVector& state, const Controls& planned_controls, bool attitude) {
  const Eigen::Index n = state.size();
  const double heading = state[HoverModel::kHeading];
  DesignVector e(n + kIntegrals);
  e << state - reference_, integrals_;
  e.head<2>() = state.head<2>() - rotate(reference_[HoverModel::kHeading] - heading, reference_.head<2>());
  e[HoverModel::kHeading] = wrap_angle(heading - reference_[HoverModel::kHeading]);
  Eigen::Vector4d errors{e[HoverModel::kForward], e[HoverModel::kRight], e[HoverModel::kBelow],
                         e[HoverModel::kHeading]};
  if (attitude) e.segment<2>(n).setZero();

  // Velocity errors and their integrals may use only the tilt that the reference flight leaves.
  const Eigen::Vector2d planned{reference_[HoverModel::kPitchAngle], reference_[HoverModel::kRollAngle]};
  const Eigen::Vector2d from_error = -hold_slopes_.tilt_per_mps.cwiseProduct(Eigen::Vector2d(e.head<2>()));
  const Eigen::Vector2d from_integral = -hold_slopes_.tilt_per_m.cwiseProduct(Eigen::Vector2d(e.segment<2>(n)));
  const Eigen::Vector2d wanted = planned + from_error + from_integral;
  const bool tilt_limited = wanted.norm() > config_.tilt_limit_rad;
  if (tilt_limited) {
    const Eigen::Vector2d left = clamp_norm(wanted, config_.tilt_limit_rad) - planned - from_integral;
    e.head<2>() = -left.cwiseQuotient(hold_slopes_.tilt_per_mps);
  }
  const Controls u = -K_hold_ * e;

  // Anti-windup: an integral does not grow while a limit holds.
  const Controls total = model_.trim + planned_controls + u;
  const bool saturated =
      (total.array() < model_.lowest.array()).any() || (total.array() > model_.highest.array()).any();
  if (attitude) errors.head<2>().setZero();
  for (int i = 0; i < kIntegrals; ++i) {
    const bool grows = errors[i] * integrals_[i] > 0.0;
    const bool limited = saturated || (tilt_limited && i < 2);
    if (!(limited && grows)) integrals_[i] += dt_s_ * errors[i];
  }
  return u;
}

/// The reference flight follows the linear model. As it turns, its velocity over ground is constant.
void Autopilot::advance_reference(const Controls& u) {
  DesignVector x = reference_;
  x[HoverModel::kHeading] = 0.0;
  x[HoverModel::kBelow] = 0.0;
  DesignVector next = step_.A * x + step_.B * u;
  next.head<2>() = rotate(-next[HoverModel::kHeading], next.head<2>());
  next[HoverModel::kBelow] += reference_[HoverModel::kBelow];
  next[HoverModel::kHeading] = wrap_angle(next[HoverModel::kHeading] + reference_[HoverModel::kHeading]);
  reference_ = next;
}

}  // namespace hedgehop::dynamics::control
