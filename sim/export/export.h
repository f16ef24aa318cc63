#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Layouts that other programs read.
enum class DataFormat { euroc, tum, kitti };

struct ExportRequest {
  DataFormat format = DataFormat::euroc;
  std::vector<std::string>
      cameras;                ///< roles, in the order of cam0, cam1 ...; empty: all of the rig but those of depth
  bool truth = false;         ///< write TrueImages, too
  std::filesystem::path out;  ///< folder that does not exist or is empty
};

/// Re-simulates a scenario and writes all sensors' readings, at their full rates, with their imperfections, and the
/// truth. Depth of a TUM set is true. Throws InputError for a camera that the rig lacks or the format cannot hold, and
/// for a folder that is not empty; std::runtime_error for a file that cannot be written.
/// @param progress  as FlightWatcher::on_progress. @return the flight, the same as without recording.
Flight export_flight(const Scenario& scenario, const ExportRequest& request,
                     const std::function<void(double t_s, double duration_s, double goal_distance_m)>& progress);

}  // namespace hedgehop::sim
