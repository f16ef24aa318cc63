#pragma once

#include <filesystem>
#include <memory>

#include "sim/export/log_sink.h"
#include "sim/logfile/chunk_compressor.h"

namespace hedgehop::sim {

struct RosbagOptions {
  ChunkCompression compression = ChunkCompression::zstd;
  bool compressed_images = false;  ///< PNG in CompressedImage instead of Image
};

/// Returns the log of a flight as a bag of ROS 2: an MCAP file of profile ros2 and metadata.yaml [Rosbag2Humble] sec.
/// "metadata.yaml". Topics are in docs/logs.md. Frames: "map" (E), "odom" (E as the vehicle estimates it), "base_link"
/// (F), "<role>_optical_frame", "<role>_level" (Cl of LevelScan). Times count from kStartTimeNs.
/// @param folder  exists.
std::unique_ptr<LogSink> rosbag_log(const std::filesystem::path& folder, const RosbagOptions& options);

}  // namespace hedgehop::sim
