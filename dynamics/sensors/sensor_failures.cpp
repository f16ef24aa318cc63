#include "dynamics/sensors/sensor_failures.h"

namespace hedgehop::dynamics::sensors {

SensorFailures::SensorFailures(std::vector<SensorFailure> failures) {
  for (const SensorFailure& failure : failures) failures_.push_back({failure, RandomStream(failure.seed)});
}

std::optional<Eigen::Vector3d> SensorFailures::failed(Instrument instrument, int64_t t_ns,
                                                      std::optional<Eigen::Vector3d> reading) {
  std::optional<Eigen::Vector3d>& last = last_[static_cast<size_t>(instrument)];
  for (auto& [failure, noise] : failures_) {
    if (failure.instrument != instrument || t_ns < failure.from_ns || t_ns >= failure.until_ns) continue;
    switch (failure.mode) {
      case SensorFailure::Mode::off:
        return std::nullopt;
      case SensorFailure::Mode::stuck:
        return last;
      case SensorFailure::Mode::bias:
        if (reading) (*reading)[failure.axis] += failure.value;
        break;
      case SensorFailure::Mode::noise:
        if (reading) *reading += failure.value * normal3(noise);
        break;
    }
  }
  if (reading) last = reading;
  return reading;
}

}  // namespace hedgehop::dynamics::sensors
