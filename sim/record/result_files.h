#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// What a run's record holds besides the flight itself.
struct RunInfo {
  std::string scenario;                       ///< the scenario's name
  uint64_t seed = 0;                          ///< of the run
  std::string version;                        ///< of Hedgehop
  std::string build;                          ///< identity of the build
  std::map<std::string, std::string> inputs;  ///< files that the flight depends on, with their SHA-256
  std::string scenario_file;                  ///< as it was named
  std::string command_line;                   ///< that runs this again
  std::string scenario_yaml;                  ///< the resolved scenario
};

/// Removes the verdict of an earlier flight and what is made of it: of two flights in one folder, the other files would
/// tell of one and these of the other.
void forget_flight(const std::filesystem::path& run_folder);

/// Writes scenario.yaml, result.json, trajectory.csv, decisions.csv and, of a module that makes a map, map.json into
/// `run_folder`, which is created when missing; forgets an earlier flight there. Each file is written aside and then
/// renamed, so a file that is there is whole. Throws std::runtime_error naming the file and the cause (full disk,
/// missing permission).
void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight);

/// What result.json holds: keys in a fixed order, null for what is not finite.
nlohmann::ordered_json result_data(const RunInfo& info, const FlightResult& result);
/// Text of result.json: keys in a fixed order, two spaces of indent, `null` for what is not finite.
std::string result_json(const RunInfo& info, const FlightResult& result);
/// Texts of trajectory.csv and decisions.csv, see flight_columns.h. An empty field is unknown, `inf` a clearance to
/// nothing.
std::string trajectory_csv(const Flight& flight);
std::string decisions_csv(const Flight& flight);

}  // namespace hedgehop::sim
