#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "avoidance/flow_balance/ranging.h"

/// Our additions to the goal-directed law of balance_law.h.
namespace hedgehop::avoidance::flow_balance {

/// What is near in every direction of the plan. Between two cameras, and around the focus of expansion, flow measures
/// nothing: there a point that was measured before is remembered and carried along with the vehicle's own motion, so
/// that a building does not vanish while it passes from one camera to the next. This closes the blind spots between the
/// cameras that [Garratt2009] sec. 4.1 reports at 45 degrees. Ours.
class RangeRing {
 public:
  /// How long a point is remembered: twice the time in which it passes a blind spot 8 m away at 2 m/s.
  static constexpr int64_t kKeepNs = 4'000'000'000;

  /// Moves on in time. @param v_WB_W  estimated velocity since the last call, m/s. @param t_ns  rising.
  void carry(const Eigen::Vector2d& v_WB_W, int64_t t_ns);
  /// Takes in what a camera's columns measure now. One that shows enough parallax replaces what was remembered in its
  /// direction, any other adds to it. @param heading_rad  estimated.
  void add(const std::vector<RangeColumn>& columns, double heading_rad);

  /// The nearest point known in each sector of 5 degrees, from the vehicle, in W, m.
  std::vector<Eigen::Vector2d> obstacles_W() const;

 private:
  static constexpr int kSectors = 72;
  struct RingPoint {
    Eigen::Vector2d p_BP_W;
    int64_t seen_ns;
  };
  static size_t sector_of(const Eigen::Vector2d& direction_W);
  void keep_nearer(const RingPoint& point);

  std::array<std::optional<RingPoint>, kSectors> points_;
  int64_t now_ns_ = 0;
};

/// Returns the velocity to add to the target velocity, in W, m/s. In each quarter of the plan, the first about the aim,
/// the three nearest places push back along their directions, together by `gain_m2ps` times their mean inverse range.
/// With a gain of k0 + k1 and walls at right angles to the aim it equals push_from_walls(). It also holds for what a
/// camera sees at its edge, and for what lies straight ahead of the motion.
/// @param obstacles_W  from the vehicle, m. @param aim_W  direction to fly, not zero.
Eigen::Vector2d push_from_obstacles(const std::vector<Eigen::Vector2d>& obstacles_W, const Eigen::Vector2d& aim_W,
                                    double gain_m2ps);

/// Returns a command after a first-order low-pass filter, m/s. [Garratt2009] sec. 4.1 suggests one.
/// @param v_last_W  the last filtered command, m/s.  @param dt_s  since then, >= 0.
/// @param time_constant_s  0 for no filter.
Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s);

/// Leaves limit cycles: when the vehicle has made no progress to its goal for a while, the aim is rotated aside for a
/// while, to the right and, if that did not help, to the left. Ours; [Garratt2009] sec. 4.1 aims aside all the time for
/// the same purpose.
class Detour {
 public:
  static constexpr double kAngleRad = 70.0 * std::numbers::pi / 180.0;  ///< along the face of a building, nearly
  static constexpr double kDurationS = 12.0;                            ///< past a building of 20 m at 2 m/s

  /// @param patience_s  without progress, >= 0; 0 never aims aside.
  explicit Detour(double patience_s) : patience_s_(patience_s) {}

  /// @param goal_distance_m  now, >= 0.  @param t_s  since the flight began, rising.
  /// @return angle to rotate the aim to the right by, rad; 0 outside detours.
  double update(double goal_distance_m, double t_s);
  /// Detours so far.
  int count() const { return count_; }

 private:
  double patience_s_;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< so far
  double progress_s_ = 0.0;  ///< when it was last improved on, or the last detour ended
  double until_s_ = 0.0;     ///< end of the current detour
  double side_ = -1.0;
  int count_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
