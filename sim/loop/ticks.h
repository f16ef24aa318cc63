#pragma once

#include <cstdint>

namespace hedgehop::sim {

/// The flight's clock: integer ticks of the physics rate. Every event is on a tick.
class Ticks {
 public:
  /// @param physics_rate_hz  from 1 to 10,000.
  explicit Ticks(int64_t physics_rate_hz) : rate_hz_(physics_rate_hz) {}

  /// Returns tick / rate, rounded once, to the nearest nanosecond. @param tick  of at most a day, >= 0.
  int64_t t_ns(int64_t tick) const { return (tick * kNsPerS + rate_hz_ / 2) / rate_hz_; }
  /// Returns the tick of a time of t_ns().
  int64_t tick(int64_t t_ns) const { return (t_ns * rate_hz_ + kNsPerS / 2) / kNsPerS; }
  double t_s(int64_t tick) const { return static_cast<double>(tick) / static_cast<double>(rate_hz_); }
  double dt_s() const { return 1.0 / static_cast<double>(rate_hz_); }

  /// Returns the ticks between two events of a rate that divides the physics rate.
  int64_t period(double rate_hz) const { return static_cast<int64_t>(static_cast<double>(rate_hz_) / rate_hz + 0.5); }
  /// Returns a duration in ticks, rounded to the nearest.
  int64_t ticks(double duration_s) const {
    return static_cast<int64_t>(duration_s * static_cast<double>(rate_hz_) + 0.5);
  }

 private:
  static constexpr int64_t kNsPerS = 1'000'000'000;
  int64_t rate_hz_;
};

}  // namespace hedgehop::sim
