#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// What a run's record says besides the flight itself.
struct RunInfo {
  std::string scenario;       ///< the scenario's name
  uint64_t seed = 0;          ///< of the run
  std::string version;        ///< of Hedgehop
  std::string build;          ///< identity of the build
  std::string scenario_file;  ///< as it was named
  std::string command_line;   ///< that runs this again
  std::string scenario_yaml;  ///< the resolved scenario
};

/// Writes scenario.yaml, result.json, trajectory.csv, decisions.csv and, of a module that keeps a chart, map.json into
/// `run_folder`, which is made when missing. Each file is written aside and then renamed, so a file that is there is
/// whole. Throws std::runtime_error naming the file and the cause (full disk, missing permission).
void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight);

/// Text of result.json: keys in a fixed order, two spaces of indent, `null` for what is not finite.
std::string result_json(const RunInfo& info, const FlightResult& result);
/// Text of trajectory.csv: one row per control tick, units in the header. Numbers are the shortest that read back to
/// the same double; an empty field is not known, `inf` a clearance to nothing.
std::string trajectory_csv(const Flight& flight);
/// Text of decisions.csv: one row per decision; the module's signals are the columns from the seventh on.
std::string decisions_csv(const Flight& flight);

}  // namespace hedgehop::sim
