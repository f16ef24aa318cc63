#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "sim/export/export.h"

namespace hedgehop::sim {

/// Does the work of export_flight() for a log.
Flight export_log(const Scenario& scenario, const ExportRequest& request,
                  const std::function<void(double t_s, double duration_s, double goal_distance_m)>& progress,
                  const std::filesystem::path& run_folder);

/// Returns the time of the start of a flight in a format, ns since 1970.
int64_t start_time_ns(DataFormat format);

/// Throws InputError unless the folder does not exist or is empty, and can be written.
void require_empty(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
