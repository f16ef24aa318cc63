#include "sim/flightlog/linear_predictor.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace hedgehop::sim {
namespace {

constexpr Eigen::Index kStates = 8, kTurn = 8, kMoved = 9, kOutputs = 12;
using LinearState = Eigen::Matrix<double, kStates, 1>;

Eigen::Quaterniond heading_frame(double heading_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
}

/// A state as the linear model sees it, and the part that it does not see.
struct Level {
  LinearState x;
  double heading_rad;
};
Level level_of(const dynamics::RigidBodyState& state) {
  const Eigen::Vector3d rpy = dynamics::to_roll_pitch_heading(state.q_WB);
  Level out{LinearState::Zero(), rpy[2]};
  out.x << heading_frame(rpy[2]).conjugate() * (state.q_WB * state.v_WB_B), rpy[0], rpy[1], state.w_WB_B;
  return out;
}

Eigen::VectorXd regressor(const LinearState& x, const RecordedFlight& flight, size_t sample) {
  Eigen::VectorXd z(kStates + flight.inputs.cols() + 1);
  z << x, flight.inputs.row(static_cast<Eigen::Index>(sample)).transpose(), 1.0;
  return z;
}

}  // namespace

LinearPredictor::LinearPredictor(std::span<const LogPart> parts) {
  const Eigen::Index size = kStates + parts.front().flight->inputs.cols() + 1;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(size, size), moments = Eigen::MatrixXd::Zero(size, kOutputs);
  for (const LogPart& part : parts) {
    const RecordedFlight& flight = *part.flight;
    for (size_t i = part.begin; i + 1 < part.end; ++i) {
      if (flight.gap_after[i]) continue;
      const Level now = level_of(flight.states[i]), next = level_of(flight.states[i + 1]);
      Eigen::Matrix<double, kOutputs, 1> y;
      y << next.x, dynamics::wrap_angle(next.heading_rad - now.heading_rad),
          heading_frame(now.heading_rad).conjugate() * (flight.states[i + 1].p_WB - flight.states[i].p_WB);
      const Eigen::VectorXd z = regressor(now.x, flight, i);
      gram.noalias() += z * z.transpose();
      moments.noalias() += z * y.transpose();
    }
  }
  // Scaled to unit diagonal, with a weight far below any real input, so that constant inputs do no harm.
  constexpr double kRidge = 1e-12;
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseMax(1e-12).cwiseInverse();
  Eigen::MatrixXd balanced = scale.asDiagonal() * gram * scale.asDiagonal();
  balanced.diagonal().array() += kRidge;
  rows_ = (scale.asDiagonal() * balanced.ldlt().solve(scale.asDiagonal() * moments)).transpose();
}

std::vector<dynamics::RigidBodyState> LinearPredictor::predict(const RecordedFlight& flight, size_t start,
                                                               size_t count) const {
  std::vector<dynamics::RigidBodyState> states;
  Level now = level_of(flight.states[start]);
  Eigen::Vector3d p_WB = flight.states[start].p_WB;
  for (size_t i = start; i < start + count; ++i) {
    const Eigen::VectorXd y = rows_ * regressor(now.x, flight, i);
    p_WB += heading_frame(now.heading_rad) * y.segment<3>(kMoved);
    now = {y.head<kStates>(), now.heading_rad + y[kTurn]};
    dynamics::RigidBodyState state;
    state.p_WB = p_WB;
    state.q_WB = dynamics::from_roll_pitch_heading(now.x[3], now.x[4], now.heading_rad);
    state.v_WB_B = state.q_WB.conjugate() * (heading_frame(now.heading_rad) * now.x.head<3>());
    state.w_WB_B = now.x.tail<3>();
    states.push_back(state);
  }
  return states;
}

}  // namespace hedgehop::sim
