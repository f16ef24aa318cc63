#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "dynamics/rigid_body.h"
#include "dynamics/vehicle.h"
#include "sim/flightlog/log_columns.h"
#include "sim/flightlog/recorded_flight.h"

namespace hedgehop::sim {

/// Flies a vehicle with the recorded inputs of a log, from measured states.
///
/// During the warm-up before a window, the body is set to the measured state at every sample, so that only motors,
/// servos, rotor and autopilot move by their own laws. From the start of the window on, the model flies alone. An input
/// acts until the next sample. Motor speeds and control positions of a log are those that the vehicle has; duty cycles
/// and controls are commands, which motors and servos follow. Before the warm-up, setpoints start the autopilot in
/// steady flight at the measured velocity.
class Replay {
 public:
  /// Throws std::invalid_argument if the vehicle cannot fly.
  explicit Replay(const dynamics::VehicleConfig& vehicle);
  ~Replay();

  /// Returns the predicted states of the samples start + 1 to start + count.
  /// @param count  the log must have these samples.
  std::vector<dynamics::RigidBodyState> predict(const RecordedFlight& flight, size_t start, size_t count);

  /// Returns the specific forces of the model at the measured states of the samples [begin, end), in B, m/s2. Motors,
  /// servos and rotor follow the log from the warm-up before `begin` on.
  std::vector<Eigen::Vector3d> specific_forces_B(const RecordedFlight& flight, size_t begin, size_t end);

 private:
  class Flyer;
  /// Brings the vehicle to the measured state of `start`, with actuators and rotor that followed the log until then.
  void warm_up(const RecordedFlight& flight, size_t start);

  std::unique_ptr<Flyer> flyer_;
};

}  // namespace hedgehop::sim
