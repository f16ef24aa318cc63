#pragma once

#include <functional>

#include "dynamics/sensors/ranger.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// A range finder that looks down: height above whatever surface lies below. The defaults are those of a small laser
/// altimeter. A sonar hears the nearest echo in a cone: rate 20 Hz, max 5 m, cone 15 deg [PX4Gazebo2024]; its echo is
/// up to 0.03 s old.
struct HeightSensorConfig {
  RangerConfig ranger;
  double cone_rad = 0.0;  ///< half angle of the cone it listens in; 0 for a single beam
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HeightSensorConfig> auto& c) {
  describe(v, c.ranger);
  v("cone", c.cone_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 45.0,
     .meaning = "half angle of the cone whose nearest echo it reads: about 15 for a sonar, 0 for a laser"});
}

/// Height of a point above the surface below it, m; +inf above nothing. The point lies level with the sensor, so far to
/// the north and east of it, m.
using HeightBeside = std::function<double(double north_m, double east_m)>;

/// Returns the distance of what the sensor hears first, m: the nearest point in its cone about the plumb line.
/// @param below_m  height above the surface right below. @param beside  of the surfaces around; it is not called
/// a single beam. Simplified: surfaces are seen from above, on rings at most 0.5 m apart; walls beside the cone reflect
/// the sound away.
double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightBeside& beside);

}  // namespace hedgehop::dynamics::sensors
