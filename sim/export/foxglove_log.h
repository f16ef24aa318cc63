#pragma once

#include <filesystem>
#include <memory>

#include "sim/export/log_sink.h"
#include "sim/logfile/chunk_compressor.h"

namespace hedgehop::sim {

/// Returns the log of a flight as an MCAP file of protobuf messages, with the schemas of Foxglove or our own:
/// topics in docs/logs.md. Frames: "world" (E), "body" (F), "camera/<role>", and mover_frame(). Times count from
/// 0.
std::unique_ptr<LogSink> foxglove_log(const std::filesystem::path& file, ChunkCompression compression);

}  // namespace hedgehop::sim
