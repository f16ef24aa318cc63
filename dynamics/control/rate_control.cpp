#include "dynamics/control/rate_control.h"

#include <Eigen/QR>
#include <cmath>
#include <vector>

namespace hedgehop::dynamics::control {
namespace {

// Deviations of equal cost, chosen so that a rate is reached in a few tenths of a second.
constexpr double kAcceptableRateRadps = 0.3, kAcceptableAngleRad = 0.1;

}  // namespace

RateControl::RateControl(const HoverModel& model, double dt_s)
    : dt_s_(dt_s), trim_(model.trim), lowest_(model.lowest), highest_(model.highest) {
  // The rates turn much faster than attitude and velocity change them.
  std::vector<Eigen::Index> kept = {HoverModel::kP, HoverModel::kQ, HoverModel::kR};
  for (Eigen::Index i = HoverModel::kHidden; i < model.motion.A.rows(); ++i) kept.push_back(i);
  const LinearSystem motion{model.motion.A(kept, kept), model.motion.B(kept, Eigen::all)};
  const auto n = static_cast<Eigen::Index>(kept.size());
  step_ = sampled(motion, dt_s);
  hidden_ = DesignVector::Zero(n - kRates);
  solve_steady_turn(motion);

  LinearSystem augmented{DesignMatrix::Zero(n + kRates, n + kRates), DesignMatrix::Zero(n + kRates, kTorques)};
  augmented.A.topLeftCorner(n, n) = motion.A;
  augmented.A.block(n, 0, kRates, kRates).setIdentity();
  augmented.B.topRows(n) = motion.B.rightCols(kTorques);
  DesignVector q = DesignVector::Zero(n + kRates);
  q.head<kRates>().setConstant(1.0 / (kAcceptableRateRadps * kAcceptableRateRadps));
  q.tail<kRates>().setConstant(1.0 / (kAcceptableAngleRad * kAcceptableAngleRad));
  const DesignVector r = model.acceptable.tail<kTorques>().array().square().inverse();
  K_ = lqr_gain(sampled(augmented, dt_s), q.asDiagonal(), r.asDiagonal());
}

/// Solves for the hidden states and the controls of a turn at constant rates.
void RateControl::solve_steady_turn(const LinearSystem& motion) {
  const Eigen::Index n = motion.A.rows(), hidden = n - kRates;
  Eigen::MatrixXd unknown(n, hidden + kTorques);
  unknown << motion.A.rightCols(hidden), motion.B.rightCols(kTorques);
  const Eigen::MatrixXd found = unknown.completeOrthogonalDecomposition().solve(-motion.A.leftCols(kRates));
  steady_hidden_ = found.topRows(hidden);
  steady_torque_ = found.bottomRows(kTorques);
}

Controls RateControl::control(const RateSetpoint& setpoint, const Eigen::Vector3d& w_WB_B_est) {
  const Eigen::Index n = kRates + hidden_.size();
  const Eigen::Vector3d errors = w_WB_B_est - setpoint.w_WB_B;
  DesignVector e(n + kRates);
  e << errors, hidden_ - steady_hidden_ * setpoint.w_WB_B, integrals_;
  Controls wanted = trim_;
  wanted[kHeave] = std::lerp(lowest_[kHeave], highest_[kHeave], setpoint.thrust);
  wanted.tail<kTorques>() += steady_torque_ * setpoint.w_WB_B - K_ * e;
  const Controls given = wanted.cwiseMax(lowest_).cwiseMin(highest_);

  // Anti-windup: an integral does not grow while its control is at a limit.
  for (Eigen::Index i = 0; i < kRates; ++i) {
    const bool limited = given[kRoll + i] != wanted[kRoll + i];
    if (!(limited && errors[i] * integrals_[i] > 0.0)) integrals_[i] += dt_s_ * errors[i];
  }
  DesignVector x(n);
  x << w_WB_B_est, hidden_;
  hidden_ = (step_.A.bottomRows(hidden_.size()) * x + step_.B.bottomRows(hidden_.size()) * (given - trim_)).eval();
  return given;
}

}  // namespace hedgehop::dynamics::control
