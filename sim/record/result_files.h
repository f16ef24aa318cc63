#pragma once

#include <filesystem>
#include <string>

#include "sim/flight/flight.h"
#include "sim/flight/result_io.h"

namespace hedgehop::sim {

/// Removes the result of an earlier flight and the pages from it, so that all files of the folder belong to one flight.
void forget_flight(const std::filesystem::path& run_folder);

/// Writes scenario.yaml, result.json, trajectory.csv, decisions.csv and, for a module with a map, map.json into
/// `run_folder`. Creates the folder if necessary, and calls forget_flight(). Each file is complete or absent. Throws
/// std::runtime_error with the file and the cause (full disk, missing permission).
void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight);

/// Return the texts of trajectory.csv and decisions.csv, see flight_columns.h. Empty fields are unknown; `inf` is a
/// clearance without obstacles.
std::string trajectory_csv(const Flight& flight);
std::string decisions_csv(const Flight& flight);

}  // namespace hedgehop::sim
