#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scenes/scene.h"
#include "sim/flight/flight.h"
#include "sim/record/result_files.h"
#include "sim/record/table.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The data of the pages of a run.
struct RunRecord {
  Scenario scenario;
  std::string scenario_yaml;                   ///< the resolved scenario
  std::shared_ptr<const scenes::Scene> scene;  ///< of the flight
  RunResult result;
  Table trajectory, decisions;
  nlohmann::ordered_json map;  ///< as in map.json; null for a module without a map
};

/// Returns the record of a flight in memory.
RunRecord run_record(const Scenario& scenario, const RunInfo& info, const Flight& flight);

/// Returns the record of a run from scenario.yaml, result.json, trajectory.csv, decisions.csv and map.json in its
/// folder. The scene is generated again from the scenario and its seed. Throws std::runtime_error with the file and the
/// cause if a file is missing or malformed.
RunRecord read_run(const std::filesystem::path& run_folder);

/// Returns the map of a module and the truth for map.json and the report. Frame W, m:
/// `points` {n, e, d, covariance: [nn, ne, ee], true} (covariance seen from above, m^2; true is null if the corners of
/// the scene are unknown), `corners` {n, e, d, counts, found}, `course` [[n, e]...], `paths` {t, places: [[n, e]...]}.
nlohmann::ordered_json map_data(const MapRecord& map);

}  // namespace hedgehop::sim
