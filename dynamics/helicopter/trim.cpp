#include "dynamics/helicopter/trim.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace hedgehop::dynamics::helicopter {
namespace {

/// Unknowns of Newton's method: collective, tail, roll, pitch, disc back, disc right.
using Unknowns = Eigen::Matrix<double, 6, 1>;
constexpr double kResidual = 1e-11;  // of accelerations, in g and in rad/s2
constexpr int kMaxNewtonSteps = 50;
constexpr double kMaxStepRad = 0.1;
constexpr double kSpeedStepMps = 2.0;  // between the trims on the way to a fast one

Trim evaluate(const Airframe& airframe, const Unknowns& x, const Eigen::Vector3d& v_air_W, double heading_rad) {
  Trim t;
  t.roll_rad = x[2];
  t.pitch_rad = x[3];
  t.blades.collective_rad = x[0];
  t.blades.tail_rad = x[1];
  t.state.body.q_WB = from_roll_pitch_heading(x[2], x[3], heading_rad);
  t.state.body.v_WB_B = t.state.body.q_WB.conjugate() * v_air_W;
  t.state.flap.back_rad = x[4];
  t.state.flap.right_rad = x[5];
  t.loads = airframe.loads(t.state, t.blades);
  return t;
}

Unknowns residual(const MassProperties& mass, const Trim& t) {
  const RigidBodyVector rate = derivative(mass, t.state.body, t.loads.f_B, t.loads.t_B);
  Unknowns r;
  r << rate.segment<3>(7) / kGravityMps2, rate.segment<3>(10);
  return r;
}

/// Newton's method with a numeric Jacobian and bounded steps. Returns whether it converged.
bool solve(const Airframe& airframe, Unknowns& x, const Eigen::Vector3d& v_air_W, double heading_rad) {
  const auto f = [&](const Unknowns& y) {
    return residual(airframe.mass, evaluate(airframe, y, v_air_W, heading_rad));
  };
  constexpr double kDifference = 1e-6;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const Unknowns r = f(x);
    if (!r.allFinite()) return false;
    if (r.cwiseAbs().maxCoeff() < kResidual) return true;
    Eigen::Matrix<double, 6, 6> J;
    for (int k = 0; k < 6; ++k) {
      const Unknowns step = kDifference * Unknowns::Unit(k);
      J.col(k) = (f(x + step) - f(x - step)) / (2.0 * kDifference);
    }
    const Unknowns dx = J.partialPivLu().solve(r);
    if (!dx.allFinite()) return false;
    x -= dx * std::min(1.0, kMaxStepRad / dx.cwiseAbs().maxCoeff());
  }
  return f(x).cwiseAbs().maxCoeff() < 10.0 * kResidual;
}

}  // namespace

std::optional<Trim> trim(const Airframe& airframe, const Eigen::Vector3d& v_air_W, double heading_rad) {
  // From the hover to the required speed; each trim is the initial guess of the next.
  const int steps = std::max(1, static_cast<int>(std::ceil(v_air_W.norm() / kSpeedStepMps)));
  if (!v_air_W.allFinite() || steps > 100) return std::nullopt;
  Unknowns x;
  x << 0.1, 0.1, 0.0, 0.0, 0.0, 0.0;
  for (int i = 0; i <= steps; ++i) {
    if (!solve(airframe, x, v_air_W * i / steps, heading_rad)) return std::nullopt;
  }

  Trim found = evaluate(airframe, x, v_air_W, heading_rad);
  const Eigen::Vector2d cyclic = steady_cyclic(airframe.flapping, found.state.flap, found.loads.main_rotor.flap_input);
  found.blades.lateral_rad = cyclic[0];
  found.blades.longitudinal_rad = cyclic[1];
  found.loads = airframe.loads(found.state, found.blades);
  return found;
}

namespace {

using StateVector = Eigen::Matrix<double, LinearModel::kStates, 1>;
using InputVector = Eigen::Matrix<double, LinearModel::kInputs, 1>;

/// Returns the rates of the linear model's states at a deviation from the trim. Attitude rates follow from Euler's
/// kinematic equations.
StateVector rates(const Airframe& airframe, const Trim& trim, double heading_rad, const StateVector& dx,
                  const InputVector& du) {
  using L = LinearModel;
  const double roll = trim.roll_rad + dx[L::kRollAngle];
  const double pitch = trim.pitch_rad + dx[L::kPitchAngle];
  HelicopterState s = trim.state;
  s.body.q_WB = from_roll_pitch_heading(roll, pitch, heading_rad + dx[L::kHeading]);
  s.body.v_WB_B += dx.segment<3>(L::kU);
  s.body.w_WB_B += dx.segment<3>(L::kP);
  s.flap = {s.flap.back_rad + dx[L::kDiscBack], s.flap.right_rad + dx[L::kDiscRight],
            s.flap.bar_back_rad + dx[L::kBarBack], s.flap.bar_right_rad + dx[L::kBarRight]};
  const BladeAngles& b = trim.blades;
  const BladeAngles blades{b.collective_rad + du[0], b.lateral_rad + du[1], b.longitudinal_rad + du[2],
                           b.tail_rad + du[3]};
  const HelicopterLoads loads = airframe.loads(s, blades);
  HelicopterVector rate;
  rate << derivative(airframe.mass, s.body, loads.f_B, loads.t_B),
      derivative(airframe.flapping, s.flap, loads.main_rotor.flap_input);

  const Eigen::Vector3d& w = s.body.w_WB_B;
  const double turn = w.y() * std::sin(roll) + w.z() * std::cos(roll);
  StateVector out;
  out << rate.segment<6>(7), w.x() + turn * std::tan(pitch), w.y() * std::cos(roll) - w.z() * std::sin(roll),
      turn / std::cos(pitch), rate.tail<4>();
  return out;
}

}  // namespace

LinearModel linearize(const Airframe& airframe, const Trim& trim) {
  constexpr double kDifference = 1e-5;
  const double heading = to_roll_pitch_heading(trim.state.body.q_WB)[2];
  LinearModel linear;
  for (int k = 0; k < LinearModel::kStates; ++k) {
    const StateVector dx = kDifference * StateVector::Unit(k);
    const InputVector none = InputVector::Zero();
    linear.A.col(k) =
        (rates(airframe, trim, heading, dx, none) - rates(airframe, trim, heading, -dx, none)) / (2.0 * kDifference);
  }
  for (int k = 0; k < LinearModel::kInputs; ++k) {
    const InputVector du = kDifference * InputVector::Unit(k);
    const StateVector none = StateVector::Zero();
    linear.B.col(k) =
        (rates(airframe, trim, heading, none, du) - rates(airframe, trim, heading, none, -du)) / (2.0 * kDifference);
  }
  return linear;
}

}  // namespace hedgehop::dynamics::helicopter
