#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// How late a subscriber may come: it gets only new messages, or also the last one (of a static topic).
enum class RosDurability { fleeting, latched };

struct RosTopic {
  std::string name, type;
  RosDurability durability = RosDurability::fleeting;
  uint64_t messages = 0;
};

/// Returns the QoS profiles of a topic as rosbag2 stores them in bags of version 5: reliable, keep the last 10.
std::string qos_profiles(RosDurability durability);

/// Returns metadata.yaml of a bag with one MCAP file. @param start_ns  time of the first message since 1970.
std::string rosbag_metadata(const std::string& file, int64_t start_ns, int64_t duration_ns,
                            const std::vector<RosTopic>& topics);

}  // namespace hedgehop::sim
