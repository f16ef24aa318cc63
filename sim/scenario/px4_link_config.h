#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/fields/field.h"
#include "sim/mavlink/companion_config.h"

namespace hedgehop::sim {

/// PX4 with its simulator interface.
struct Px4LinkConfig {
  static constexpr std::string_view kName = "px4";
  static constexpr std::string_view kMeaning = "PX4 software in the loop: Hedgehop is its simulator, over TCP";
  int64_t port = 4560, offboard_port = 14540, autopilot_port = 14580, instance = 0;
  std::vector<std::string> command;
  int64_t frame_class = 1, frame_type = 1;
  mavlink::CompanionConfig companion;
  std::optional<double> stand_altitude_m;  ///< above W's origin, positive up; default: the start's altitude
  double start_radius_m = 1.0, start_speed_mps = 1.0;
  double start_within_s = 300.0;
  double first_packet_s = 60.0, unanswered_s = 2.0;  ///< wall times

  int64_t tcp_port() const { return port + instance; }
  int64_t own_udp_port() const { return offboard_port + instance; }
  int64_t autopilot_udp_port() const { return autopilot_port + instance; }
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Px4LinkConfig> auto& c) {
  v("port", c.port,
    {.at_least = 1, .at_most = 64000, .meaning = "TCP port of the simulator; instance N uses port + N"});
  v("offboard_port", c.offboard_port,
    {.at_least = 1,
     .at_most = 64000,
     .meaning = "UDP port to which PX4 sends its messages; instance N uses offboard_port + N"});
  v("autopilot_port", c.autopilot_port,
    {.at_least = 1,
     .at_most = 64000,
     .meaning = "UDP port on which PX4 receives messages; instance N uses autopilot_port + N"});
  v("instance", c.instance,
    {.at_least = 0, .at_most = 99, .meaning = "number of the autopilot; parallel flights add their worker's number"});
  v("command", c.command,
    {.meaning = "program and arguments that start the autopilot, one for each flight; {instance}, {port} and {seed} "
                "are replaced; empty: it is started by hand"});
  v("frame_class", c.frame_class,
    {.at_least = 0, .at_most = 100, .meaning = "motors of the airframe: 1 quad, 2 hexa, 3 octo, 4 octoquad"});
  v("frame_type", c.frame_type, {.at_least = 0, .at_most = 100, .meaning = "their arrangement: 0 plus, 1 X"});
  v("companion", c.companion, {.meaning = "messages to the autopilot over UDP"});
  v("stand_altitude", c.stand_altitude_m,
    {.unit = "m",
     .meaning = "altitude of the stand that holds the vehicle until its thrust exceeds its weight, above the scene's "
                "origin; default: the start's altitude"});
  v("start_radius", c.start_radius_m,
    {.unit = "m", .above = 0.0, .meaning = "distance from the start within which the flight and its clock begin"});
  v("start_speed", c.start_speed_mps,
    {.unit = "m/s", .above = 0.0, .meaning = "maximum speed at which the flight and its clock begin"});
  v("start_within", c.start_within_s,
    {.unit = "s", .above = 0.0, .at_most = 3600.0, .meaning = "maximum time of the autopilot before the flight"});
  v("wait", c.first_packet_s,
    {.unit = "s", .above = 0.0, .at_most = 3600.0, .meaning = "wall time to wait for the autopilot's connection"});
  v("unanswered_after", c.unanswered_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "wall time after which the flight goes on with the last controls; 100 times in a row end it"});
}

}  // namespace hedgehop::sim
