#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/logfile/protobuf_schema.h"

namespace hedgehop::sim {

/// Returns the messages of Foxglove that logs use, with all their fields [FoxgloveSchemas2026] sec. "schemas/proto",
/// and those of google.protobuf that they contain.
std::span<const ProtobufMessage> foxglove_messages();

/// Returns a message with a time stamp (field 1), then texts, then doubles, in order.
ProtobufMessage table_message(const std::string& name, const std::vector<std::string>& texts,
                              const std::vector<std::string>& numbers);

}  // namespace hedgehop::sim
