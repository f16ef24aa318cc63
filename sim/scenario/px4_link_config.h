#pragma once

#include <cstdint>
#include <string_view>

#include "sim/fields/field.h"
#include "sim/mavlink/companion_config.h"
#include "sim/scenario/autopilot_start_config.h"

namespace hedgehop::sim {

/// PX4 with its simulator interface.
struct Px4LinkConfig {
  static constexpr std::string_view kName = "px4";
  static constexpr std::string_view kMeaning = "PX4 software in the loop: Hedgehop is its simulator, over TCP";
  int64_t port = 4560, offboard_port = 14540, autopilot_port = 14580;
  AutopilotStartConfig start;
  int64_t frame_class = 1, frame_type = 1;
  mavlink::CompanionConfig companion;
  double unanswered_s = 2.0;  ///< wall time

  int64_t tcp_port() const { return port + start.instance; }
  int64_t own_udp_port() const { return offboard_port + start.instance; }
  int64_t autopilot_udp_port() const { return autopilot_port + start.instance; }
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
  describe(v, c.start);
  v("frame_class", c.frame_class,
    {.at_least = 0, .at_most = 100, .meaning = "motors of the airframe: 1 quad, 2 hexa, 3 octo, 4 octoquad"});
  v("frame_type", c.frame_type, {.at_least = 0, .at_most = 100, .meaning = "their arrangement: 0 plus, 1 X"});
  v("companion", c.companion, {.meaning = "messages to the autopilot over UDP"});
  v("unanswered_after", c.unanswered_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "wall time after which the flight goes on with the last controls; 100 times in a row end it"});
}

}  // namespace hedgehop::sim
