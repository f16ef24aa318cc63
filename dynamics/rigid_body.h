#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/fields/field.h"

/// Motion of one rigid body. Frames: W north-east-down, B forward-right-down with its origin at the mass center.
namespace hedgehop::dynamics {

inline constexpr double kGravityMps2 = 9.81;  ///< along W's z

struct RigidBodyState {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();            ///< position of B in W, m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< attitude of B in W, unit
  Eigen::Vector3d v_WB_B = Eigen::Vector3d::Zero();          ///< velocity of B in W, expressed in B, m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          ///< angular velocity of B in W, expressed in B, rad/s
};

/// A rigid body's state or its time derivative as one column: p, q (scalar first), v, w.
using RigidBodyVector = Eigen::Matrix<double, 13, 1>;
RigidBodyVector to_vector(const RigidBodyState& state);
/// @param x  the norm of its quaternion is positive and is kept.
RigidBodyState to_rigid_body(const RigidBodyVector& x);

struct MassProperties {
  double mass_kg = 1.0;                                   ///< > 0
  Eigen::Matrix3d I_B = Eigen::Matrix3d::Identity();      ///< inertia about the mass center in B, kg m2
  Eigen::Matrix3d I_B_inv = Eigen::Matrix3d::Identity();  ///< its inverse
};
/// @param principal_kgm2  I_xx, I_yy, I_zz. @param xz_kgm2  product of inertia I_xz (off-diagonal elements are -I_xz).
/// Throws std::invalid_argument unless mass and principal moments are positive and the moments obey the triangle
/// inequality.
MassProperties make_mass_properties(double mass_kg, const Eigen::Vector3d& principal_kgm2, double xz_kgm2);

/// Returns the time derivative of the state under gravity and the loads.
/// @param f_B  force without gravity, in B, N. @param t_B  torque about the mass center, in B, N m.
/// Source: [StevensLewis2003] sec. on flat-earth equations of motion.
RigidBodyVector derivative(const MassProperties& mass, const RigidBodyState& state, const Eigen::Vector3d& f_B,
                           const Eigen::Vector3d& t_B);

/// Returns roll, pitch and heading (3-2-1), rad. @param q_WB  unit.
Eigen::Vector3d to_roll_pitch_heading(const Eigen::Quaterniond& q_WB);
Eigen::Quaterniond from_roll_pitch_heading(double roll_rad, double pitch_rad, double heading_rad);
/// Returns the angle between the body's z axis and the vertical, rad. @param roll_pitch_heading_rad  3-2-1.
double tilt_rad(const Eigen::Vector3d& roll_pitch_heading_rad);
/// Returns the same angle in -pi..pi, rad.
double wrap_angle(double angle_rad);

struct MassConfig {
  double mass_kg = 8.2;
  Eigen::Vector3d inertia_kgm2{0.18, 0.34, 0.28};
  double inertia_xz_kgm2 = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MassConfig> auto& c) {
  v("mass", c.mass_kg, {.unit = "kg", .above = 0.0, .meaning = "mass, ready to fly"});
  v("inertia", c.inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "moments of inertia about roll, pitch and yaw, at the mass center"});
  v("inertia_xz", c.inertia_xz_kgm2, {.unit = "kg m2", .meaning = "product of inertia I_xz"});
}

/// Returns x one step later by the classical fourth-order Runge-Kutta method.
/// @param t_s   time of x. @param h_s  step.
/// @param rate  pure, `Vector rate(double t_s, const Vector& x)`.
/// Source: [HairerNorsettWanner1993] sec. II.1.
template <int N, class Rate>
Eigen::Matrix<double, N, 1> rk4_step(const Eigen::Matrix<double, N, 1>& x, double t_s, double h_s, const Rate& rate) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const Vector k1 = rate(t_s, x);
  const Vector k2 = rate(t_s + 0.5 * h_s, Vector(x + 0.5 * h_s * k1));
  const Vector k3 = rate(t_s + 0.5 * h_s, Vector(x + 0.5 * h_s * k2));
  const Vector k4 = rate(t_s + h_s, Vector(x + h_s * k3));
  return x + h_s / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace hedgehop::dynamics
