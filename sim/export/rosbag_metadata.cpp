#include "sim/export/rosbag_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "sim/config/outline_texts.h"

namespace hedgehop::sim {

std::string qos_profiles(RosDurability durability) {
  constexpr int kKeepLast = 1, kReliable = 1, kTransientLocal = 1, kVolatile = 2, kAutomatic = 1;
  constexpr const char* kForever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format(
      "- history: {}\n  depth: 10\n  reliability: {}\n  durability: {}\n  deadline:{}  lifespan:{}  liveliness: {}\n"
      "  liveliness_lease_duration:{}  avoid_ros_namespace_conventions: false",
      kKeepLast, kReliable, durability == RosDurability::latched ? kTransientLocal : kVolatile, kForever, kForever,
      kAutomatic, kForever);
}

std::string rosbag_metadata(const std::string& file, int64_t start_ns, int64_t duration_ns,
                            const std::vector<RosTopic>& topics) {
  const uint64_t messages = std::accumulate(topics.begin(), topics.end(), uint64_t{0},
                                            [](uint64_t sum, const RosTopic& topic) { return sum + topic.messages; });
  std::string text = fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  duration:\n    nanoseconds: {}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {}\n  message_count: {}\n  topics_with_message_count:\n",
      duration_ns, start_ns, messages);
  for (const RosTopic& topic : topics) {
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n"
        "        offered_qos_profiles: {}\n      message_count: {}\n",
        topic.name, topic.type, yaml_quoted(qos_profiles(topic.durability)), topic.messages);
  }
  return text +
         fmt::format(
             "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - {0}\n  files:\n"
             "    - path: {0}\n      starting_time:\n        nanoseconds_since_epoch: {1}\n      duration:\n"
             "        nanoseconds: {2}\n      message_count: {3}\n",
             file, start_ns, duration_ns, messages);
}

}  // namespace hedgehop::sim
