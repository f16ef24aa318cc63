#include "dynamics/rigid_body.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics {

RigidBodyVector to_vector(const RigidBodyState& state) {
  RigidBodyVector x;
  x << state.p_WB, state.q_WB.w(), state.q_WB.vec(), state.v_WB_B, state.w_WB_B;
  return x;
}

RigidBodyState to_rigid_body(const RigidBodyVector& x) {
  return {x.segment<3>(0), Eigen::Quaterniond(x[3], x[4], x[5], x[6]), x.segment<3>(7), x.segment<3>(10)};
}

MassProperties make_mass_properties(double mass_kg, const Eigen::Vector3d& principal_kgm2, double xz_kgm2) {
  if (!(mass_kg > 0.0) || !std::isfinite(mass_kg)) {
    throw std::invalid_argument("mass must be positive, got " + std::to_string(mass_kg) + " kg");
  }
  MassProperties mass;
  mass.mass_kg = mass_kg;
  mass.I_B = principal_kgm2.asDiagonal();
  mass.I_B(0, 2) = mass.I_B(2, 0) = -xz_kgm2;
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass.I_B).eigenvalues();
  if (!mass.I_B.allFinite() || !(moments[0] > 0.0) || moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-9)) {
    throw fields::InvalidField(
        "mass.inertia",
        "is not that of a rigid body: principal moments must be positive and at most the sum of the other two, "
        "got " +
            std::to_string(moments[0]) + ", " + std::to_string(moments[1]) + ", " + std::to_string(moments[2]) +
            " kg m2");
  }
  mass.I_B_inv = mass.I_B.inverse();
  return mass;
}

RigidBodyVector derivative(const MassProperties& mass, const RigidBodyState& state, const Eigen::Vector3d& f_B,
                           const Eigen::Vector3d& t_B) {
  const Eigen::Quaterniond q = state.q_WB.normalized();
  const Eigen::Matrix3d R_WB = q.toRotationMatrix();
  const Eigen::Vector3d& v = state.v_WB_B;
  const Eigen::Vector3d& w = state.w_WB_B;
  const Eigen::Vector3d g_B = kGravityMps2 * R_WB.row(2).transpose();

  RigidBodyVector rate;
  rate.segment<3>(0) = R_WB * v;
  rate[3] = -0.5 * state.q_WB.vec().dot(w);
  rate.segment<3>(4) = 0.5 * (state.q_WB.w() * w + state.q_WB.vec().cross(w));
  rate.segment<3>(7) = f_B / mass.mass_kg + g_B - w.cross(v);
  rate.segment<3>(10) = mass.I_B_inv * (t_B - w.cross(mass.I_B * w));
  return rate;
}

Eigen::Vector3d to_roll_pitch_heading(const Eigen::Quaterniond& q_WB) {
  const Eigen::Matrix3d R_WB = q_WB.toRotationMatrix();
  return {std::atan2(R_WB(2, 1), R_WB(2, 2)), std::asin(std::clamp(-R_WB(2, 0), -1.0, 1.0)),
          std::atan2(R_WB(1, 0), R_WB(0, 0))};
}

double tilt_rad(const Eigen::Vector3d& rpy) {
  return std::acos(std::clamp(std::cos(rpy.x()) * std::cos(rpy.y()), -1.0, 1.0));
}

double wrap_angle(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

Eigen::Quaterniond from_roll_pitch_heading(double roll_rad, double pitch_rad, double heading_rad) {
  return Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

}  // namespace hedgehop::dynamics
