#pragma once

#include <optional>

#include "avoidance/camera_flow.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::landmark_map {

/// Stops the flight in front of a surface without corners, by the divergence of the flow or by a single-beam range
/// finder. Not in the thesis; after the proposal of [Shah2009] ch. 7.
class WallStop {
 public:
  /// @param time_to_contact_s  time to contact below which the flight stops, >= 0; 0 disables the stop by flow.
  explicit WallStop(double time_to_contact_s) : time_to_contact_s_(time_to_contact_s) {}

  /// Adds the measurements of one decision. Once true, the result remains true. @param flow  newest measurement; empty
  /// without images.
  bool update(const std::optional<CameraFlow::Measure>& flow, const NavigationState& navigation);

  bool stopped() const { return stopped_; }
  double loom_per_s() const { return loom_per_s_; }  ///< smoothed; 0 if too small a part of the image has flow

 private:
  void smooth(const std::optional<CameraFlow::Measure>& flow);

  double time_to_contact_s_;
  double loom_per_s_ = 0.0;
  int alarms_ = 0;
  bool stopped_ = false;
};

/// Remaining range after the stop, m: rotor radius of the largest vehicle plus 2 m.
inline constexpr double kStopRangeM = 5.0;
/// Assumed deceleration, m/s^2: gentle for all vehicles, so that the tilt does not lift the beam.
inline constexpr double kBrakingMps2 = 0.5;
/// Time until a stop takes effect, s: latency and tilt of the vehicle.
inline constexpr double kReactionS = 0.5;

}  // namespace hedgehop::avoidance::landmark_map
