#pragma once

#include <filesystem>
#include <memory>

#include "sim/export/log_sink.h"

namespace hedgehop::sim {

/// Returns the log of a flight as a ULog file, without images. Topics with the names of PX4 have its fields, frames and
/// units: W (north, east, down) and B (forward, right, down). docs/logs.md lists all. Times count from 0.
std::unique_ptr<LogSink> ulog_log(const std::filesystem::path& file);

}  // namespace hedgehop::sim
