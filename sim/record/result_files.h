#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Information on a run in addition to its flight.
struct RunInfo {
  std::string scenario;                       ///< name of the scenario
  uint64_t seed = 0;                          ///< of the run
  std::string version;                        ///< of Hedgehop
  std::string build;                          ///< identity of the build
  std::map<std::string, std::string> inputs;  ///< files that the flight depends on, with their SHA-256
  std::string scenario_file;                  ///< as given by the user
  std::string command_line;                   ///< of a re-run
  std::string scenario_yaml;                  ///< the resolved scenario
};

/// Removes the result of an earlier flight and the pages from it, so that all files of the folder belong to one flight.
void forget_flight(const std::filesystem::path& run_folder);

/// Writes scenario.yaml, result.json, trajectory.csv, decisions.csv and, for a module with a map, map.json into
/// `run_folder`. Creates the folder if necessary, and calls forget_flight(). Each file is complete or absent. Throws
/// std::runtime_error with the file and the cause (full disk, missing permission).
void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight);

/// Returns the contents of result.json: keys in a fixed order, null for numbers that are not finite.
nlohmann::ordered_json result_data(const RunInfo& info, const FlightResult& result);
/// Returns the text of result.json, indented by two spaces.
std::string result_json(const RunInfo& info, const FlightResult& result);
/// Return the texts of trajectory.csv and decisions.csv, see flight_columns.h. Empty fields are unknown; `inf` is a
/// clearance without obstacles.
std::string trajectory_csv(const Flight& flight);
std::string decisions_csv(const Flight& flight);

}  // namespace hedgehop::sim
