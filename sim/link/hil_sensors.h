#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "dynamics/sensors/barometer.h"
#include "dynamics/sensors/gps.h"
#include "dynamics/sensors/imu.h"
#include "sim/libm/random.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/mavlink/hil_messages.h"

namespace hedgehop::sim::link {

/// The sensors that PX4 reads from its simulator. They have noise, because PX4 takes a constant reading for a broken
/// sensor, but no offsets: a vehicle is calibrated. W's origin is PX4's default home.
class HilSensors {
 public:
  static constexpr int64_t kImuRateHz = 250;

  /// @param physics_rate_hz  a multiple of kImuRateHz. @param seed  of the run.
  HilSensors(int64_t physics_rate_hz, uint64_t seed);

  /// Physics steps between two readings of the IMU.
  int64_t period() const { return imu_.period(); }
  /// Returns the time of a physics step, us.
  uint64_t time_us(int64_t step) const { return static_cast<uint64_t>(step * 1'000'000 / physics_rate_hz_); }

  /// Takes the true state after each physics step, in their order.
  void observe(const OutsideInput& input);
  /// Returns the readings on a step of the IMU: compass at 100 Hz, barometer at 50 Hz.
  mavlink::HilSensor sensor(const OutsideInput& input);
  /// Returns the fix that arrives on this step of the IMU, if any; 5 per second.
  std::optional<mavlink::HilGps> gps(int64_t step);
  /// Returns the true state, for PX4's log.
  mavlink::HilStateQuaternion state(const OutsideInput& input) const;

 private:
  /// Whether an event of this rate is due since the last step of the IMU.
  bool due(int64_t step, int64_t rate_hz) const;

  int64_t physics_rate_hz_;
  dynamics::sensors::Imu imu_;
  dynamics::sensors::Barometer barometer_;
  dynamics::sensors::Gps gps_;
  RandomStream field_noise_;
};

}  // namespace hedgehop::sim::link
