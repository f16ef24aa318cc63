#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/export/true_images.h"
#include "sim/flight/flight.h"
#include "sim/logfile/chunk_compressor.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Data set layouts of other programs, and log files: MCAP with Foxglove's schemas, a bag of ROS 2, ULog.
enum class DataFormat { euroc, tum, kitti, mcap, rosbag2, ulog };
/// Whether the format is a log file.
constexpr bool is_log(DataFormat format) { return format >= DataFormat::mcap; }

struct ExportRequest {
  DataFormat format = DataFormat::euroc;
  std::vector<std::string>
      cameras;         ///< roles in the order of cam0, cam1 ...; empty: all cameras of the rig with images
  bool truth = false;  ///< whether to write TrueImages and labels.json; of a log: true depth
  DepthFormat depth = DepthFormat::png_mm;                ///< of TrueImages
  ChunkCompression compression = ChunkCompression::zstd;  ///< of mcap and rosbag2
  bool compressed_images = false;                         ///< of rosbag2: PNG instead of raw images
  std::filesystem::path out;                              ///< a folder that does not exist or is empty
};

/// Re-simulates a scenario and writes the readings of all sensors at their full rates, with their imperfections, and
/// the truth. The depth of a TUM data set is true. A log also has the module's decisions and the scene. Throws
/// InputError for a camera that the rig lacks or the format does not support, and for a folder that is not empty;
/// std::runtime_error for a file that cannot be written.
/// @param progress  as FlightWatcher::on_progress. @param run_folder  with the recording of a linked flight.
/// @return the flight, equal to one without export.
Flight export_flight(const Scenario& scenario, const ExportRequest& request,
                     const std::function<void(double t_s, double duration_s, double goal_distance_m)>& progress,
                     const std::filesystem::path& run_folder = {});

}  // namespace hedgehop::sim
