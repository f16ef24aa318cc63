#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/sensors/sensor_noise.h"

namespace hedgehop::dynamics::sensors {

enum class Instrument {
  gyros,
  accelerometers,
  gps,           ///< its position
  gps_velocity,  ///< its velocity
  height_sensor,
  magnetometer,
  barometer,
  range_finder,
  velocimeter
};
inline constexpr size_t kInstruments = 9;

/// What ails an instrument for a while, in what its readings are made of.
struct SensorFailure {
  enum class Mode {
    off,    ///< no reading; of gyros and accelerometers, 0
    stuck,  ///< its last reading again and again
    bias,   ///< `value` is added to component `axis`
    noise   ///< white, of standard deviation `value`, is added to every component
  };
  Instrument instrument = Instrument::gps;
  Mode mode = Mode::off;
  int64_t from_ns = 0, until_ns = 0;  ///< until is not part of it
  double value = 0.0;
  int axis = 0;
  uint64_t seed = 0;  ///< of its own stream
};

/// The failures of a flight. Without any, readings pass as they are.
class SensorFailures {
 public:
  SensorFailures() = default;
  explicit SensorFailures(std::vector<SensorFailure> failures);

  /// What is delivered of a reading; none where none was made, or the instrument is off. Time rises.
  std::optional<Eigen::Vector3d> deliver(Instrument instrument, int64_t t_ns, std::optional<Eigen::Vector3d> reading) {
    return failures_.empty() ? reading : failed(instrument, t_ns, reading);
  }
  std::optional<double> deliver(Instrument instrument, int64_t t_ns, std::optional<double> reading) {
    if (failures_.empty()) return reading;
    const auto vector = reading ? std::optional(Eigen::Vector3d(*reading, 0.0, 0.0)) : std::nullopt;
    const std::optional<Eigen::Vector3d> delivered = failed(instrument, t_ns, vector);
    return delivered ? std::optional(delivered->x()) : std::nullopt;
  }

 private:
  struct Failing {
    SensorFailure failure;
    RandomStream noise;
  };
  std::optional<Eigen::Vector3d> failed(Instrument instrument, int64_t t_ns, std::optional<Eigen::Vector3d> reading);

  std::vector<Failing> failures_;
  std::array<std::optional<Eigen::Vector3d>, kInstruments> last_;  ///< delivered by each
};

}  // namespace hedgehop::dynamics::sensors
