#pragma once

#include <limits>

namespace hedgehop::avoidance::flow_balance {

/// Leaves limit cycles on the way to a goal: when the goal has come no nearer for a while, the aim is turned aside for
/// a while, to the one side and, if that did not help, to the other. [Garratt2009] sec. 4.1 turns the aim all the time
/// for the same purpose.
class Detour {
 public:
  struct Config {
    double patience_s = 0.0;  ///< without progress; 0 never turns aside
    double angle_rad = 0.0;   ///< the aim is turned by it, > 0
    double duration_s = 0.0;  ///< of one detour, > 0
  };
  explicit Detour(const Config& config) : config_(config) {}

  /// @param goal_distance_m  now, >= 0. @param t_s  since the flight began, rising.
  /// @return angle to turn the aim to the right by, rad; 0 while all is well.
  double update(double goal_distance_m, double t_s);
  int count() const { return count_; }

 private:
  Config config_;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< so far
  double progress_s_ = 0.0;  ///< when it was last improved on, or the last detour ended
  double until_s_ = 0.0;     ///< end of the detour under way
  double side_ = -1.0;
  int count_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
