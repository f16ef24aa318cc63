#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "avoidance/flow_balance/ranging.h"

/// Additions of the modified law to the goal-directed law of balance_law.h.
namespace hedgehop::avoidance::flow_balance {

/// The nearest obstacles in all horizontal directions. Flow gives no range between two cameras and around the focus of
/// expansion. In these directions an earlier point is kept and moved with the motion of the vehicle, so that a building
/// does not vanish while it passes from one camera to the next. This closes the blind spots between the cameras that
/// [Garratt2009] sec. 4.1 reports at 45 degrees. Not in the paper.
class RangeRing {
 public:
  struct Options {
    double memory_s = 4.0;   ///< lifetime of a point without a measurement in its direction, > 0: twice the time in
                             ///< which a point 8 m away passes a blind spot at 2 m/s
    double release_s = 0.0;  ///< time constant with which the inverse range of a point decreases to a smaller
                             ///< measurement, >= 0; 0: at once
  };
  explicit RangeRing(const Options& options) : options_(options) {}

  /// Moves the points to a new time. @param v_WB_W  estimated velocity since the last call, m/s. @param t_ns
  /// increasing.
  void carry(const Eigen::Vector2d& v_WB_W, int64_t t_ns);
  /// Adds the current measurements of the columns of a camera. A nearer obstacle replaces the point in its direction at
  /// once, a farther one or none gradually, and only if the column has sufficient parallax.
  /// @param heading_rad  estimated. @param dt_s  time since the last image of the camera, > 0.
  void add(const std::vector<RangeColumn>& columns, double heading_rad, double dt_s);

  /// Nearest known point of each sector of 5 degrees, from the vehicle, in W, m.
  std::vector<Eigen::Vector2d> obstacles_W() const;

 private:
  static constexpr int kSectors = 72;
  static constexpr double kFarM = 40.0;  ///< farther obstacles do not push
  struct RingPoint {
    Eigen::Vector2d p_BP_W;
    int64_t seen_ns;
  };
  static size_t sector_of(const Eigen::Vector2d& direction_W);
  void keep_nearer(const RingPoint& point);
  /// Moves the point in the direction of a column toward its measurement.  @param share  of the difference, 0 to 1.
  void release(std::optional<RingPoint>& point, double inverse_range_per_m, double share) const;

  Options options_;
  std::array<std::optional<RingPoint>, kSectors> points_;
  int64_t now_ns_ = 0;
};

/// Returns the velocity to add to the target velocity, in W, m/s. In each quarter of the horizontal plane, the first
/// one centered on the aim, the three nearest points push back along their directions. Together they push with
/// `gain_m2ps` times their mean inverse range.
/// With a gain of k0 + k1 and walls at right angles to the aim the result equals push_from_walls(). It is also valid
/// for obstacles at the edge of an image and for obstacles straight ahead of the motion.
/// @param obstacles_W  from the vehicle, m. @param aim_W  direction to fly, not zero.
Eigen::Vector2d push_from_obstacles(const std::vector<Eigen::Vector2d>& obstacles_W, const Eigen::Vector2d& aim_W,
                                    double gain_m2ps);

/// Returns the command after a first-order low-pass filter, m/s. [Garratt2009] sec. 4.1 suggests such a filter.
/// @param v_last_W  last filtered command, m/s.  @param dt_s  time since that command, >= 0.
/// @param time_constant_s  0 disables the filter.
Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s);

/// Leaves limit cycles. If the vehicle has made no progress to its goal for some time, the aim is rotated aside for
/// some time: first to the right and, if that did not help, to the left. If neither helped, the next detours last twice
/// as long, because shorter ways have been tried. Not in the paper; [Garratt2009] sec. 4.1 aims aside permanently for
/// the same purpose.
class Detour {
 public:
  static constexpr double kAngleRad = 70.0 * std::numbers::pi / 180.0;  ///< almost along the face of a building
  static constexpr double kDurationS = 12.0;  ///< of the first detours: time to pass a building of 20 m at 2 m/s
  static constexpr int kMaxDoublings = 3;     ///< 96 s, more than the width of a city of 150 m

  /// @param patience_s  time without progress before a detour, >= 0; 0 disables detours.
  explicit Detour(double patience_s) : patience_s_(patience_s) {}

  /// @param goal_distance_m  current distance, >= 0.  @param t_s  time since the start of the flight, increasing.
  /// @return angle by which to rotate the aim to the right, rad; 0 outside detours.
  double update(double goal_distance_m, double t_s);
  /// Number of detours so far.
  int count() const { return count_; }

 private:
  double patience_s_;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< minimum distance to the goal so far
  double progress_s_ = 0.0;  ///< time of the last progress or of the end of the last detour
  double until_s_ = 0.0;     ///< end of the current detour
  double side_ = -1.0;
  int count_ = 0;
  int fruitless_ = 0;  ///< detours since the last progress
};

}  // namespace hedgehop::avoidance::flow_balance
