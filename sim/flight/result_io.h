#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/flight/flight.h"
#include "sim/flight/json_file.h"

/// result.json: its only writer and its only reader.
namespace hedgehop::sim {

/// Data of a run that are not part of the flight.
struct RunInfo {
  std::string scenario;                       ///< the scenario's name
  uint64_t seed = 0;                          ///< of the run
  std::string version;                        ///< of Hedgehop
  std::string build;                          ///< identity of the build
  std::map<std::string, std::string> inputs;  ///< input files of the flight, with their SHA-256
  std::string scenario_file;                  ///< as the user named it
  std::string command_line;                   ///< flies this run again
  std::string scenario_yaml;                  ///< the resolved scenario; in scenario.yaml, not in result.json
};

/// The content of a result.json.
struct RunResult {
  RunInfo info;
  FlightResult flight;
};

/// Returns result.json with its keys in a fixed order. Absent values and values that are not finite are null.
nlohmann::ordered_json to_json(const RunInfo& info, const FlightResult& result);

/// Inverse of to_json(). Returns +inf for a clearance that is null, NaN for any other number that is null, and no value
/// for an optional number that is null. Unknown keys are ignored; keys that this version added may be missing.
/// Throws InputError, without the file's name, for a required key that is missing, a value of another type, and a key
/// of an earlier version (the message gives the new name).
RunResult result_from_json(const nlohmann::ordered_json& json);

/// Returns the text of result.json: to_json() with an indent of two spaces.
std::string result_json(const RunInfo& info, const FlightResult& result);

/// Reads a result.json. Throws as read_json() and result_from_json(), naming the file.
RunResult read_result(const std::filesystem::path& file);

}  // namespace hedgehop::sim
