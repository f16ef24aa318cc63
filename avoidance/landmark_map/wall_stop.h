#pragma once

#include <optional>

#include "avoidance/camera_flow.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::landmark_map {

/// Stops the flight before a surface without corners, by the divergence of the flow or by a single beam. Ours, after
/// the proposal of [Shah2009] ch. 7.
class WallStop {
 public:
  /// @param time_to_contact_s  of a surface that stops the flight, >= 0; 0 never stops it by flow.
  explicit WallStop(double time_to_contact_s) : time_to_contact_s_(time_to_contact_s) {}

  /// Takes in one decision's measurements; once true the stop holds. @param flow  the newest; none without images.
  bool update(const std::optional<CameraFlow::Measure>& flow, const NavigationState& navigation);

  bool stopped() const { return stopped_; }
  double loom_per_s() const { return loom_per_s_; }  ///< smoothed; 0 while too little of the image flows

 private:
  void smooth(const std::optional<CameraFlow::Measure>& flow);

  double time_to_contact_s_;
  double loom_per_s_ = 0.0;
  int alarms_ = 0;
  bool stopped_ = false;
};

/// Left to what a range finder meets once the flight has stopped, m: a rotor radius of the largest vehicle and 2 m.
inline constexpr double kStopRangeM = 5.0;
/// Deceleration counted on before a range, m/s^2: gentle for all vehicles, so that the tilt does not lift the beam.
inline constexpr double kBrakingMps2 = 0.5;
/// Until a stop takes effect, s: latency and the vehicle's tilt.
inline constexpr double kReactionS = 0.5;

}  // namespace hedgehop::avoidance::landmark_map
