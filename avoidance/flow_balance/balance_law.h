#pragma once

#include <Eigen/Core>
#include <span>

/// The steering laws of [Garratt2009] sec. 4 as pure functions. Frame H: B turned level, x along the heading, y to the
/// right.
namespace hedgehop::avoidance::flow_balance {

/// What one camera senses of the walls it looks at.
struct WallSense {
  Eigen::Vector2d axis_H = Eigen::Vector2d::UnitX();   ///< where it looks: C's z, level part
  Eigen::Vector2d right_H = Eigen::Vector2d::UnitY();  ///< to the right in its image: C's x, level part
  double flow_radps = 0.0;                             ///< mean horizontal flow Q
  double loom_per_s = 0.0;                             ///< loom L, > 0 when approaching
  double near_per_m = 0.0;                             ///< inverse range of the nearest patches, >= 0
};

/// Two estimates of 1 / range of what one camera sees; negative ones are noise.
struct InverseRanges {
  double from_flow_per_m = 0.0, from_loom_per_m = 0.0;
};

/// `velocity_mps` with a magnitude of at least `floor_mps`, keeping its sign (0 counts as positive).
double saturated_divisor(double velocity_mps, double floor_mps);

/// Returns how near the walls before a camera are, from its own motion across its axis (flow) and along it (loom):
///   Q = -v_right / z  gives  1/z = -Q / v_right ,    L = v_axis / z  gives  1/z = L / v_axis .
/// With V the velocity in H (x forward, y right) this reads, camera by camera:
///   front: -Q_F / V_y and  L_F / V_x     rear:   Q_A / V_y and -L_A / V_x
///   left:  -Q_L / V_x and -L_L / V_y     right:  Q_R / V_x and  L_R / V_y
/// @param v_H  velocity in H, m/s.  @param floor_mps  least magnitude of a divisor, > 0.
InverseRanges inverse_ranges(const WallSense& sense, const Eigen::Vector2d& v_H, double floor_mps);

/// Returns the velocity to add to the target velocity: away from the nearer walls, in H, m/s,
///   V_x += k0 (1/z_A - 1/z_F)_loom + k1 (1/z_A - 1/z_F)_flow ,   V_y += k0 (1/z_L - 1/z_R)_loom + k1 (...)_flow ,
/// written for cameras that look anywhere: each pushes back along its axis.
/// Source: [Garratt2009] eq. (4). Differs: the print divides flow and loom by the same velocity; as the text says, flow
/// is divided by the velocity across the camera's axis. Signs are derived, see inverse_ranges().
Eigen::Vector2d push_from_walls(std::span<const WallSense> senses, const Eigen::Vector2d& v_H, double loom_gain_m2ps,
                                double flow_gain_m2ps, double floor_mps);

/// Returns the velocity to add to the target velocity, in H, m/s: every camera pushes back along its axis by `gain`
/// times the inverse range of its nearest patches. With gain = k0 + k1 it equals push_from_walls() before a wall at
/// right angles to a camera's axis, and unlike it also holds for what a camera sees at its edge or ahead of the motion.
Eigen::Vector2d push_from_nearest(std::span<const WallSense> senses, double gain_m2ps);

}  // namespace hedgehop::avoidance::flow_balance
