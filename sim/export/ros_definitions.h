#pragma once

#include <string>

namespace hedgehop::sim {

/// Returns the definition of a ROS 2 message type and of all types in it, as the schema of an MCAP channel
/// [MCAP2024] sec. "ros2msg": fields only, as in ROS 2 Humble and later. @param type  such as "sensor_msgs/msg/Image".
/// Throws std::out_of_range for a type that logs do not use.
std::string ros_definition(const std::string& type);

}  // namespace hedgehop::sim
