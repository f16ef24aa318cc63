#include "sim/record/run_record.h"

#include "sim/config/whole_file.h"
#include "sim/record/flight_columns.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

std::shared_ptr<const scenes::Scene> regenerate_scene(const Scenario& scenario, uint64_t seed) {
  return std::make_shared<const scenes::Scene>(build_scene(scenario.scene, scenario.world_seed.value_or(seed)));
}

}  // namespace

RunRecord run_record(const Scenario& scenario, const RunInfo& info, const Flight& flight) {
  return {.scenario = scenario,
          .scenario_yaml = info.scenario_yaml,
          .scene = flight.scene ? flight.scene : regenerate_scene(scenario, info.seed),
          .result = {.info = info, .flight = flight.result},
          .trajectory = trajectory_columns(flight),
          .decisions = decision_columns(flight),
          .map = flight.map.empty() ? nlohmann::ordered_json(nullptr) : map_data(flight.map)};
}

RunRecord read_run(const std::filesystem::path& run_folder) {
  RunRecord run;
  run.result = read_result(run_folder / "result.json");
  run.trajectory = read_columns(run_folder / "trajectory.csv");
  run.decisions = read_columns(run_folder / "decisions.csv", kDecisionWords);
  run.scenario = load_scenario(run_folder / "scenario.yaml");
  run.scenario_yaml = read_file_whole(run_folder / "scenario.yaml");
  run.scene = regenerate_scene(run.scenario, run.result.info.seed);
  if (const std::filesystem::path map = run_folder / "map.json"; std::filesystem::exists(map)) {
    run.map = read_json(map);
  }
  return run;
}

}  // namespace hedgehop::sim
