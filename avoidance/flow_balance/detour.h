#pragma once

#include <limits>
#include <numbers>

namespace hedgehop::avoidance::flow_balance {

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
