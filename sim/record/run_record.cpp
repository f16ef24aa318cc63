#include "sim/record/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/record/flight_columns.h"
#include "sim/record/map_data.h"
#include "sim/record/whole_file.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxDepth = 50;  // copying and printing JSON is recursive

Json read_json(const std::filesystem::path& file) {
  const auto bounded = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > kMaxDepth) throw InputError(fmt::format("{}: is nested deeper than {}", file.string(), kMaxDepth));
    return true;
  };
  try {
    return Json::parse(read_file_whole(file), bounded);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// Returns a result with one item in each list and map, as written by result_data().
Json whole_result() {
  FlightResult result;
  result.truth_used.emplace_back();
  result.failures.emplace_back();
  result.closest_obstacle.distance_m = result.closest_ground.distance_m = 0.0;
  result.checks.emplace_back();
  result.metrics.emplace_back();
  RunInfo info;
  info.inputs[""] = "";
  return result_data(info, result);
}

/// Returns whether the keys of a map are names from the flight instead of fixed members.
bool is_map(std::string_view key) {
  return key == "inputs" || key == "metrics" || key == "metric_units" || key == "metric_kinds";
}

/// Returns the path of the first part of `value` whose type differs from that in `like`; empty if there is none. Parts
/// that `like` lacks may have any type. Parts that `value` lacks are ignored. null is valid for a number and for a
/// closest approach.
std::string other_type(const Json& value, const Json& like, const std::string& path) {
  const auto in = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  const bool may_be_null = like.is_number() || like.is_null() || path.starts_with("closest_");
  if (value.is_null() && may_be_null) return "";
  if (like.is_null() ? !value.is_number() : like.is_number() ? !value.is_number() : value.type() != like.type()) {
    return path;
  }
  if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) {
      if (std::string fault = other_type(value[i], like[0], in(std::to_string(i))); !fault.empty()) return fault;
    }
  }
  if (!value.is_object()) return "";
  for (const auto& [key, part] : value.items()) {
    const auto same = is_map(path) ? like.begin() : like.find(key);
    if (same == like.end()) continue;
    if (std::string fault = other_type(part, *same, in(key)); !fault.empty()) return fault;
  }
  return "";
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

Json read_result(const std::filesystem::path& file) {
  static const Json whole = whole_result();
  Json result = read_json(file);
  const auto require = [&](bool holds, std::string_view key) {
    if (holds) return;
    throw InputError(fmt::format("{}: no result of a flight: '{}' is missing or of another type", file.string(), key));
  };
  for (const char* key : {"scenario", "version", "build", "outcome", "trajectory_hash", "seed", "metrics", "checks",
                          "flight_time_s", "min_obstacle_clearance_m"}) {
    require(result.is_object() && result.contains(key), key);
  }
  const std::string fault = other_type(result, whole, "");
  require(fault.empty(), fault);
  require(result["seed"].is_number_unsigned(), "seed");
  require(result["flight_time_s"].is_number(), "flight_time_s");
  for (const Json& check : result["checks"]) {
    for (const char* key : {"name", "passed", "unit"}) require(check.contains(key), "checks");
  }
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
