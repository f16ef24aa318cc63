#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/record/column_table.h"
#include "sim/record/result_files.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// All that a run's pages show.
struct RunRecord {
  Scenario scenario;
  std::string scenario_yaml;                   ///< the resolved scenario
  std::shared_ptr<const scenes::Scene> scene;  ///< that was flown through
  nlohmann::ordered_json result;               ///< as in result.json
  ColumnTable trajectory, decisions;
  nlohmann::ordered_json map;  ///< as in map.json; null for a module that makes no map
};

/// The record of a flight that is in memory.
RunRecord run_record(const Scenario& scenario, const RunInfo& info, const Flight& flight);

/// Reads a result.json. Throws std::runtime_error when there is none, InputError when it is not what a flight leaves: a
/// key is missing that all readers look at, any is of another type than result_data() writes, or it is nested deeply.
nlohmann::ordered_json read_result(const std::filesystem::path& file);

/// The record of a run, from its folder: scenario.yaml, result.json, trajectory.csv, decisions.csv and map.json. The
/// scene is regenerated from the scenario and its seed. Throws std::runtime_error naming the file and the cause when
/// one is missing or malformed.
RunRecord read_run(const std::filesystem::path& run_folder);

}  // namespace hedgehop::sim
