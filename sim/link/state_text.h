#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "dynamics/rigid_body.h"

namespace hedgehop::sim::link {

/// The true state that ArduPilot receives. Frames W and B are its NED and FRD.
struct PhysicsState {
  int64_t step = 0;     ///< since the first packet, > 0
  double time_s = 0.0;  ///< of the step
  dynamics::RigidBodyState body;
  Eigen::Vector3d specific_force_B = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();            ///< m/s
  std::span<const double> range_m;                             ///< of up to 6 range finders; +inf without a surface
};

/// Writes ArduPilot's JSON text into `text`: a line break, one object without spaces on one line, a line break. The
/// order of the keys suits readers that find a key as a substring. If there is a range finder, all six are written.
/// Each timestamp is 1e-10 s later per step than the time, because ArduPilot cuts its clock to whole microseconds.
/// @return whether all numbers are finite; otherwise, `text` is unspecified.
bool write_state(const PhysicsState& state, std::string& text);

}  // namespace hedgehop::sim::link
