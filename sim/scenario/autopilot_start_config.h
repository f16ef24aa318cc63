#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/fields/field.h"

namespace hedgehop::sim {

/// Start of an autopilot outside this process, and of its flight.
struct AutopilotStartConfig {
  int64_t instance = 0;
  std::vector<std::string> command;
  std::optional<double> stand_altitude_m;  ///< above W's origin, positive up; default: the start's altitude
  double radius_m = 1.0, speed_mps = 1.0;
  double within_s = 300.0;
  double first_packet_s = 60.0;  ///< wall time
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AutopilotStartConfig> auto& c) {
  v("instance", c.instance,
    {.at_least = 0, .at_most = 99, .meaning = "number of the autopilot; parallel flights add their worker's number"});
  v("command", c.command,
    {.meaning = "program and arguments that start the autopilot, one for each flight; {instance}, {port} and {seed} "
                "are replaced; empty: it is started by hand"});
  v("stand_altitude", c.stand_altitude_m,
    {.unit = "m",
     .meaning = "altitude of the stand that holds the vehicle until its thrust exceeds its weight, and on which it "
                "lands, above the scene's origin; default: the start's altitude"});
  v("start_radius", c.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "distance from the start within which the flight and its clock begin"});
  v("start_speed", c.speed_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "maximum speed at which the flight and its clock begin"});
  v("start_within", c.within_s,
    {.unit = "s", .above = 0.0, .at_most = 3600.0, .meaning = "maximum time of the autopilot before the flight"});
  v("wait", c.first_packet_s,
    {.unit = "s", .above = 0.0, .at_most = 3600.0, .meaning = "wall time to wait for the autopilot's first bytes"});
}

}  // namespace hedgehop::sim
