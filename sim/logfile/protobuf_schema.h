#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// A field of a message.
struct ProtobufField {
  std::string name;
  uint32_t number = 0;
  /// "double", "string", "bytes", "bool", "fixed32", or the full name of a message ("foxglove.Pose") or of an enum of
  /// the same message ("Level").
  std::string type;
  bool repeated = false;
};

/// An enum inside a message; the values count from 0.
struct ProtobufEnum {
  std::string name;
  std::vector<std::string> values;
};

struct ProtobufMessage {
  std::string name;  ///< full: "foxglove.Pose"
  std::vector<ProtobufField> fields;
  std::vector<ProtobufEnum> enums = {};
};

/// Returns the FileDescriptorSet that describes a message and all messages in it, as the schema of an MCAP channel
/// [MCAP2024] sec. "protobuf": one proto3 file per package, in the order of their dependence.
/// @param name  full. @param messages  all that may occur; names are unique. Throws std::invalid_argument with the name
/// of a type that is not among them.
std::string file_descriptor_set(std::string_view name, std::span<const ProtobufMessage> messages);

}  // namespace hedgehop::sim
