#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Exact motion of one rigid body. Frames: W north-east-down, B forward-right-down with its origin at the mass center.
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
/// @param x  its quaternion has any positive norm and is taken as it stands.
RigidBodyState to_rigid_body(const RigidBodyVector& x);

struct MassProperties {
  double mass_kg = 1.0;                                   ///< > 0
  Eigen::Matrix3d I_B = Eigen::Matrix3d::Identity();      ///< inertia about the mass center in B, kg m2
  Eigen::Matrix3d I_B_inv = Eigen::Matrix3d::Identity();  ///< its inverse
};
/// @param principal_kgm2  I_xx, I_yy, I_zz. @param xz_kgm2  product of inertia I_xz (off-diagonal elements are -I_xz).
/// Throws std::invalid_argument unless mass and inertia can belong to a body: positive, principal moments that obey the
/// triangle inequality.
MassProperties make_mass_properties(double mass_kg, const Eigen::Vector3d& principal_kgm2, double xz_kgm2);

/// Returns the time derivative of the state under gravity and the loads.
/// @param f_B  force without gravity, in B, N. @param t_B  torque about the mass center, in B, N m.
/// Source: [StevensLewis2003] sec. on flat-earth equations of motion.
RigidBodyVector derivative(const MassProperties& mass, const RigidBodyState& state, const Eigen::Vector3d& f_B,
                           const Eigen::Vector3d& t_B);

/// Roll, pitch and heading (3-2-1), rad. @param q  unit.
Eigen::Vector3d to_roll_pitch_heading(const Eigen::Quaterniond& q_WB);
Eigen::Quaterniond from_roll_pitch_heading(double roll_rad, double pitch_rad, double heading_rad);

}  // namespace hedgehop::dynamics
