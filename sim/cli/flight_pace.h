#pragma once

#include <chrono>
#include <functional>

namespace hedgehop::sim::cli {

/// A clock that can wait: the machine's, or that of a test.
struct PaceClock {
  using Time = std::chrono::steady_clock::time_point;

  std::function<Time()> now = std::chrono::steady_clock::now;
  std::function<void(Time)> wait_until;  ///< empty: sleeps
};

/// Lets a flight follow wall time. It only waits, so it cannot change the flight. A flight behind its pace catches up;
/// if it is more than kMaxLagS behind, the pace begins again at that instant.
class FlightPace {
 public:
  static constexpr double kMaxLagS = 0.25;

  /// @param speed  seconds of flight per second of wall time, > 0.
  explicit FlightPace(double speed = 1.0, PaceClock clock = {});

  /// Begins the pace at a time of the flight.
  void begin(double t_s);
  /// Waits until the wall time of a time of the flight.
  void keep(double t_s);

 private:
  double speed_;
  PaceClock clock_;
  PaceClock::Time begun_;
  double begun_s_ = 0.0;  ///< time of the flight at `begun_`
};

}  // namespace hedgehop::sim::cli
