#pragma once

#include <string>

namespace hedgehop::sim::cli {

/// Progress of one flight on standard error: one line redrawn where it is a terminal, else a plain line every tenth of
/// the flight's duration.
class FlightProgress {
 public:
  explicit FlightProgress(std::string name);
  /// @param goal_distance_m  NaN without a goal.
  void show(double t_s, double duration_s, double goal_distance_m);
  /// Clears the terminal's line.
  void close();

 private:
  std::string name_;
  bool terminal_;
  int tenths_shown_ = 0;
};

}  // namespace hedgehop::sim::cli
