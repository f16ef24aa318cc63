#pragma once

#include <cstdint>

namespace hedgehop::sim {

/// The flight's clock: integer ticks of the physics rate. Every event is on a tick.
class Ticks {
 public:
  /// @param physics_rate_hz  a divisor of 1e9, so that a tick is a whole number of nanoseconds.
  explicit Ticks(int64_t physics_rate_hz) : rate_hz_(physics_rate_hz), ns_per_tick_(1'000'000'000 / physics_rate_hz) {}

  int64_t t_ns(int64_t tick) const { return tick * ns_per_tick_; }
  double t_s(int64_t tick) const { return static_cast<double>(tick) / static_cast<double>(rate_hz_); }
  double dt_s() const { return 1.0 / static_cast<double>(rate_hz_); }

  /// Returns the ticks between two events of a rate that divides the physics rate.
  int64_t period(double rate_hz) const { return static_cast<int64_t>(static_cast<double>(rate_hz_) / rate_hz + 0.5); }
  /// Returns a duration in ticks, rounded to the nearest.
  int64_t ticks(double duration_s) const {
    return static_cast<int64_t>(duration_s * static_cast<double>(rate_hz_) + 0.5);
  }

 private:
  int64_t rate_hz_;
  int64_t ns_per_tick_;
};

}  // namespace hedgehop::sim
