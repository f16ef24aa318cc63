#pragma once

#include <Eigen/Core>
#include <span>

/// The goal-directed law as published in [Garratt2009] sec. 4.1. Frame H: B leveled, x along the heading, y to the
/// right.
namespace hedgehop::avoidance::flow_balance {

/// Mean flow and loom of one camera.
struct SideFlow {
  Eigen::Vector2d axis_H = Eigen::Vector2d::UnitX();   ///< optical axis: C's z, level part
  Eigen::Vector2d right_H = Eigen::Vector2d::UnitY();  ///< to the right in the image: C's x, level part
  double flow_radps = 0.0;                             ///< mean horizontal flow Q
  double loom_per_s = 0.0;                             ///< loom L, > 0 when approaching
};

/// Two estimates of 1 / range of the walls in front of one camera. Negative values are noise.
struct InverseRanges {
  double from_flow_per_m = 0.0, from_loom_per_m = 0.0;
};

/// Gains of [Garratt2009] eq. (4), with the values of sec. 4.1.
struct BalanceGains {
  double loom_m2ps = 4.0;  ///< k0
  double flow_m2ps = 5.0;  ///< k1
};

/// Minimum magnitude of a velocity by which flow or loom is divided, m/s. Source: [Garratt2009] sec. 4.1.
inline constexpr double kDivisorFloorMps = 0.2;

/// Returns `velocity_mps` with a magnitude of at least kDivisorFloorMps. The sign is kept; 0 counts as positive.
double saturated_divisor(double velocity_mps);

/// Returns the inverse range of the walls in front of a camera, from the vehicle's motion across the camera's axis
/// (flow) and along it (loom):
///   Q = -v_right / z  gives  1/z = -Q / v_right ,    L = v_axis / z  gives  1/z = L / v_axis .
/// With V the velocity in H (x forward, y right) this reads, camera by camera:
///   front: -Q_F / V_y and  L_F / V_x     rear:   Q_A / V_y and -L_A / V_x
///   left:  -Q_L / V_x and -L_L / V_y     right:  Q_R / V_x and  L_R / V_y
/// @param v_H  velocity in H, m/s.
/// Source: [Garratt2009] eq. (1), flow of translation at the image center, and eq. (3).
InverseRanges inverse_ranges(const SideFlow& side, const Eigen::Vector2d& v_H);

/// Returns the velocity to add to the target velocity: away from the nearer walls, in H, m/s,
///   V_x += k0 (1/z_A - 1/z_F)_loom + k1 (1/z_A - 1/z_F)_flow ,   V_y += k0 (1/z_L - 1/z_R)_loom + k1 (...)_flow ,
/// generalized to cameras of any direction: each camera pushes back along its axis.
/// @param v_H  velocity in H, m/s.
/// Source: [Garratt2009] eq. (4). Differs: the printed equation divides flow and loom by the same velocity. As the text
/// of the paper requires, flow is divided by the velocity across the camera axis. For the signs see inverse_ranges().
Eigen::Vector2d push_from_walls(std::span<const SideFlow> sides, const Eigen::Vector2d& v_H, const BalanceGains& gains);

/// Returns the commanded velocity in H, m/s: the sum of target velocity and push, normalized to a speed. If the two
/// cancel, the command has the direction of the target velocity.
/// @param v_tgt_H  target velocity, m/s.  @param push_H  of the walls, m/s.  @param speed_mps  >= 0.
/// Source: [Garratt2009] eq. (4) and the paragraph that follows it.
Eigen::Vector2d normalized_command(const Eigen::Vector2d& v_tgt_H, const Eigen::Vector2d& push_H, double speed_mps);

}  // namespace hedgehop::avoidance::flow_balance
