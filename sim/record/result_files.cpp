#include "sim/record/result_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "sim/record/flight_columns.h"
#include "sim/record/json_number.h"
#include "sim/record/map_data.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Makes null explicit for numbers that are not finite, so that data in memory equal those in files.
Json point(const ClosestApproach& approach) {
  if (!std::isfinite(approach.distance_m)) return nullptr;
  const Eigen::Vector3d& p = approach.p_WB_true;
  return Json{{"what", approach.what},
              {"distance_m", json_number(approach.distance_m)},
              {"t_s", json_number(approach.t_s)},
              {"north_m", json_number(p.x())},
              {"east_m", json_number(p.y())},
              {"altitude_m", json_number(-p.z())}};
}

Json stage(const StageTime& time) {
  return Json{{"median", json_number(time.median_ms)}, {"p95", json_number(time.p95_ms)}};
}

Json checks(const std::vector<CheckResult>& results) {
  Json list = Json::array();
  for (const CheckResult& check : results) {
    list.push_back(Json{{"name", check.name},
                        {"passed", check.passed},
                        {"value", json_number(check.value)},
                        {"limit", json_number(check.limit)},
                        {"unit", check.unit},
                        {"must", check.must},
                        {"t_s", json_number(check.t_s.value_or(NAN))}});
  }
  return list;
}

}  // namespace

Json result_data(const RunInfo& info, const FlightResult& result) {
  const bool by_obstacle = result.closest_obstacle.distance_m <= result.closest_ground.distance_m;
  const ClosestApproach& closest = by_obstacle ? result.closest_obstacle : result.closest_ground;
  Json json;
  json["scenario"] = info.scenario;
  json["seed"] = info.seed;
  json["version"] = info.version;
  json["build"] = info.build;
  json["inputs"] = info.inputs;
  json["scenario_file"] = info.scenario_file;
  json["command_line"] = info.command_line;
  json["outcome"] = std::string(to_string(result.outcome));
  json["cause"] = result.cause;
  json["truth_used"] = result.truth_used;
  json["failures"] = result.failures;
  json["flight_time_s"] = json_number(result.flight_time_s);
  json["path_length_m"] = json_number(result.path_length_m);
  json["min_clearance_m"] = json_number(closest.distance_m);
  json["min_clearance_time_s"] = std::isfinite(closest.distance_m) ? json_number(closest.t_s) : Json(nullptr);
  json["min_obstacle_clearance_m"] = json_number(result.closest_obstacle.distance_m);
  json["min_ground_clearance_m"] = json_number(result.closest_ground.distance_m);
  json["closest_obstacle"] = point(result.closest_obstacle);
  json["closest_ground"] = point(result.closest_ground);
  json["mean_speed_mps"] = json_number(result.mean_speed_mps);
  json["goal_distance_m"] = json_number(result.goal_distance_m.value_or(NAN));
  json["decisions"] = result.decisions;
  json["decision_ms"] = stage(result.decision_ms);
  json["render_ms"] = stage(result.render_ms);
  json["velocimeter_ms"] = stage(result.velocimeter_ms);
  json["physics_ms"] = stage(result.physics_ms);
  json["realtime_factor"] = json_number(result.realtime_factor);
  json["wall_s"] = json_number(result.wall_s);
  json["checks"] = checks(result.checks);
  json["trajectory_hash"] = result.trajectory_hash;
  json["libraries"] = Json{{"images", result.libraries.images},
                           {"functions", result.libraries.functions},
                           {"renderer", result.libraries.renderer}};
  json["scene"] = Json{{"obstacles", result.scene.solids},
                       {"least_gap_m", json_number(result.scene.smallest_gap_m)},
                       {"median_gap_m", json_number(result.scene.median_gap_m)},
                       {"covered_share", json_number(result.scene.covered_share)},
                       {"density_per_m2", json_number(result.scene.density_pm2)}};
  json["metrics"] = Json::object();
  json["metric_units"] = Json::object();
  json["metric_kinds"] = Json::object();
  for (const MetricValue& metric : result.metrics) {
    json["metrics"][metric.name] = json_number(metric.value);
    json["metric_units"][metric.name] = metric.unit;
    json["metric_kinds"][metric.name] = std::string(to_string(metric.kind));
  }
  return json;
}

std::string result_json(const RunInfo& info, const FlightResult& result) {
  return result_data(info, result).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string trajectory_csv(const Flight& flight) { return trajectory_columns(flight).csv(); }

std::string decisions_csv(const Flight& flight) { return decision_columns(flight).csv(); }

void forget_flight(const std::filesystem::path& run_folder) {
  std::error_code ignored;
  for (const char* name : {"result.json", "report.html", "replay.html", "map.json", "strip.jpg"}) {
    std::filesystem::remove(run_folder / name, ignored);
  }
}

void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight) {
  std::error_code error;
  std::filesystem::create_directories(run_folder, error);
  if (error) throw std::runtime_error(fmt::format("cannot create {}: {}", run_folder.string(), error.message()));
  forget_flight(run_folder);
  write_file_whole(run_folder / "scenario.yaml", info.scenario_yaml);
  write_file_whole(run_folder / "trajectory.csv", trajectory_csv(flight));
  write_file_whole(run_folder / "decisions.csv", decisions_csv(flight));
  if (!flight.map.empty()) write_file_whole(run_folder / "map.json", map_data(flight.map).dump() + "\n");
  write_file_whole(run_folder / "result.json",
                   result_json(info, flight.result));  // last: a run with a result is complete
}

}  // namespace hedgehop::sim
