#include "sim/record/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/record/flight_columns.h"
#include "sim/record/map_data.h"
#include "sim/record/whole_file.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/input_error.h"

namespace hedgehop::sim {
namespace {

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
  try {
    return nlohmann::ordered_json::parse(read_file_whole(file));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::shared_ptr<const scenes::Scene> regenerate_scene(const Scenario& scenario, uint64_t seed) {
  return std::make_shared<const scenes::Scene>(build_scene(scenario.scene, seed));
}

}  // namespace

RunRecord run_record(const Scenario& scenario, const RunInfo& info, const Flight& flight) {
  return {.scenario = scenario,
          .scenario_yaml = info.scenario_yaml,
          .scene = flight.scene ? flight.scene : regenerate_scene(scenario, info.seed),
          .result = result_data(info, flight.result),
          .trajectory = trajectory_columns(flight),
          .decisions = decision_columns(flight),
          .map = flight.map.empty() ? nlohmann::ordered_json(nullptr) : map_data(flight.map)};
}

nlohmann::ordered_json read_result(const std::filesystem::path& file) {
  nlohmann::ordered_json result = read_json(file);
  const auto is = [&](const char* key, auto holds) {
    if (!result.is_object() || !result.contains(key) || !holds(result[key])) {
      throw InputError(
          fmt::format("{}: no result of a flight: '{}' is missing or of another type", file.string(), key));
    }
  };
  const auto text = [](const auto& value) { return value.is_string(); };
  for (const char* key : {"scenario", "version", "build", "outcome", "trajectory_hash"}) is(key, text);
  is("seed", [](const auto& value) { return value.is_number_unsigned(); });
  is("metrics", [](const auto& value) { return value.is_object(); });
  is("checks", [](const auto& value) {
    return value.is_array() && std::ranges::all_of(value, [](const auto& check) { return check.is_object(); });
  });
  return result;
}

RunRecord read_run(const std::filesystem::path& run_folder) {
  RunRecord run;
  run.result = read_result(run_folder / "result.json");
  run.trajectory = read_columns(run_folder / "trajectory.csv");
  run.decisions = read_columns(run_folder / "decisions.csv", kDecisionWords);
  run.scenario = load_scenario(run_folder / "scenario.yaml");
  run.scenario_yaml = read_file_whole(run_folder / "scenario.yaml");
  run.scene = regenerate_scene(run.scenario, run.result.at("seed").get<uint64_t>());
  if (const std::filesystem::path map = run_folder / "map.json"; std::filesystem::exists(map)) {
    run.map = read_json(map);
  }
  return run;
}

}  // namespace hedgehop::sim
