#include "sim/pages/report.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flight/json_reader.h"
#include "sim/pages/decimate.h"
#include "sim/pages/panels.h"
#include "sim/pages/plan.h"
#include "sim/pages/report_page.h"
#include "sim/pages/run_against.h"
#include "sim/scenario/reference_path.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<double>;

Json picked(const Values& values, const std::vector<size_t>& rows, Json (*number)(double)) {
  Json list = Json::array();
  for (const size_t row : rows) list.push_back(number(values[row]));
  return list;
}

Json panel_json(const Panel& panel, size_t max_points) {
  std::vector<Values> values;
  for (const Series& series : panel.series) values.push_back(series.values);
  const std::vector<size_t> rows = decimate(values, max_points);

  Json json = {{"section", panel.section}, {"title", panel.title}, {"unit", panel.unit}, {"note", panel.note}};
  json["lowest"] = panel.lowest ? Json(*panel.lowest) : Json(nullptr);
  json["highest"] = panel.highest ? Json(*panel.highest) : Json(nullptr);
  json["limits"] = Json::array();
  for (const Limit& limit : panel.limits) json["limits"].push_back({{"label", limit.label}, {"value", limit.value}});
  json["t_s"] = picked(panel.t_s, rows, milli);
  json["series"] = Json::array();
  for (const Series& series : panel.series) {
    json["series"].push_back(
        {{"label", series.label}, {"role", series.role}, {"values", picked(series.values, rows, brief)}});
  }
  return json;
}

Json goal_json(const PlanGoal& goal) {
  return {{"n", milli(goal.p_NE_m.x())}, {"e", milli(goal.p_NE_m.y())}, {"radius", milli(goal.radius_m)}};
}

Json plan_json(const ReportScenario& scenario, const Values& down_m) {
  double lowest_m = 0.0, highest_m = 0.0;
  if (!down_m.empty()) {
    const auto [least, most] = std::ranges::minmax(down_m);
    lowest_m = -most;
    highest_m = -least;
  }
  Json json = plan_data(scenario.plan, lowest_m, highest_m);
  json["route"] = Json::array();
  for (const PlanGoal& waypoint : scenario.route) json["route"].push_back(goal_json(waypoint));
  json["goal"] = scenario.goal ? goal_json(*scenario.goal) : Json(nullptr);
  return json;
}

/// Returns the status at each row as an index of the names; -1 before the first decision.
Json status_json(const Values& t_s, const std::vector<size_t>& rows, const Table& decisions, Json& names) {
  const Values decided_s = decisions.numbers("t_s");
  const std::vector<std::string> words = decisions.words("status");
  std::vector<std::string> known;
  Json list = Json::array();
  for (const size_t row : rows) {
    const auto next = std::ranges::upper_bound(decided_s, t_s[row]);
    if (next == decided_s.begin()) {
      list.push_back(-1);
      continue;
    }
    const std::string& status = words[static_cast<size_t>(next - decided_s.begin()) - 1];
    const auto found = std::ranges::find(known, status);
    list.push_back(found - known.begin());
    if (found == known.end()) known.push_back(status);
  }
  names = known;
  return list;
}

Json path_json(const Table& trajectory, const Table& decisions, size_t max_points) {
  const Values t_s = trajectory.numbers("t_s"), north = trajectory.numbers("north_m");
  const Values east = trajectory.numbers("east_m"), clearance = trajectory.numbers("clearance_m");
  const Values v_north = trajectory.numbers("v_north_mps"), v_east = trajectory.numbers("v_east_mps");
  const Values v_down = trajectory.numbers("v_down_mps"), ground_clearance = trajectory.numbers("ground_clearance_m");
  Values speed(t_s.size()), altitude = trajectory.numbers("down_m");
  for (size_t i = 0; i < t_s.size(); ++i) {
    speed[i] = std::hypot(v_north[i], v_east[i], v_down[i]);
    altitude[i] = -altitude[i];
  }
  const std::vector<Values> kept = {north, east, clearance};
  const std::vector<size_t> rows = decimate(kept, max_points);
  Json json = {{"t", picked(t_s, rows, milli)},
               {"n", picked(north, rows, milli)},
               {"e", picked(east, rows, milli)},
               {"altitude", picked(altitude, rows, milli)},
               {"yaw", picked(trajectory.numbers("yaw_rad"), rows, milli)},
               {"clearance", picked(clearance, rows, milli)},
               {"ground_clearance", picked(ground_clearance, rows, milli)},
               {"speed", picked(speed, rows, milli)}};
  json["status"] = status_json(t_s, rows, decisions, json["statuses"]);
  return json;
}

std::vector<Limit> clearance_limits(const FlightResult& result) {
  std::vector<Limit> limits;
  for (const CheckResult& check : result.checks) {
    if (check.name == "min_clearance" && std::isfinite(check.limit)) {
      limits.push_back({"limit of the check", check.limit});
    }
  }
  return limits;
}

/// Returns the time plots in the order of their sections.
std::vector<Panel> all_panels(const Table& trajectory, const Table& decisions, const FlightResult& result) {
  std::vector<Panel> panels = trajectory_panels(trajectory, clearance_limits(result)), sorted;
  std::ranges::move(signal_panels(decisions), std::back_inserter(panels));
  for (const std::string_view section : kSections) {
    std::ranges::copy_if(panels, std::back_inserter(sorted),
                         [&](const Panel& panel) { return panel.section == section; });
  }
  return sorted;
}

/// Larger films are linked, because larger pages take seconds to open.
constexpr uintmax_t kMaxEmbeddedFilmBytes = 40'000'000;

/// Returns the name of a choice in a scenario.
template <class Choice>
std::string chosen(const Choice& choice) {
  return std::visit([](const auto& c) { return std::string(std::decay_t<decltype(c)>::kName); }, choice);
}

/// Returns the name of the module; of a foreign one, that in its library or its class.
std::string module_name(const AvoidanceConfig& config) {
  if (const PluginConfig* plugin = config.plugin()) return plugin->module;
  if (const PythonConfig* script = config.python()) return script->class_name;
  return std::string(config.name());
}

ReportScenario describe_scenario(const RunRecord& run) {
  const Scenario& scenario = run.scenario;
  ReportScenario result{.description = scenario.description,
                        .module = module_name(scenario.avoidance),
                        .scene = chosen(scenario.scene),
                        .vehicle = chosen(scenario.vehicle),
                        .yaml = run.scenario_yaml,
                        .plan = scene_plan(*run.scene)};
  const auto on_plan = [](const GoalConfig& goal) { return PlanGoal{{goal.north_m, goal.east_m}, goal.radius_m}; };
  std::ranges::transform(scenario.route, std::back_inserter(result.route), on_plan);
  if (scenario.goal) result.goal = on_plan(*scenario.goal);
  return result;
}

/// Returns the reference trajectories of the checks. One that cannot be read any more is left out.
Json references_json(const std::vector<CheckConfig>& checks) {
  Json list = Json::array();
  for (const CheckConfig& check : checks) {
    const auto* const path = std::get_if<PathToleranceCheck>(&check);
    if (!path) continue;
    try {
      Json one{{"n", Json::array()}, {"e", Json::array()}};
      for (const TimedPoint& point : read_reference_path(path->reference).points) {
        one["n"].push_back(milli(point.p_WB.x()));
        one["e"].push_back(milli(point.p_WB.y()));
      }
      list.push_back(std::move(one));
    } catch (const std::exception&) {  // the page of an old flight needs no reference
    }
  }
  return list;
}

/// Returns the comparison with the run of another folder.
Json against_json(const std::filesystem::path& run_folder, const RunRecord& run, const std::filesystem::path& against) {
  const RunRecord other = read_run(against);
  Json json = run_against_data(run_folder, run, against, other);
  json["panels"] = Json::array();
  constexpr size_t kMaxPoints = 3000;
  for (const Panel& panel : overlaid_panels(all_panels(run.trajectory, run.decisions, run.result.flight),
                                            all_panels(other.trajectory, other.decisions, other.result.flight))) {
    json["panels"].push_back(panel_json(panel, kMaxPoints));
  }
  return json;
}

std::string title(const RunRecord& run) { return run.result.info.scenario; }

/// Returns the JSON text. Texts of a module may be invalid UTF-8.
std::string text(const nlohmann::ordered_json& data) { return json_text(data); }

PageFilm find_film(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / "video.webm";
  std::error_code missing;
  const uintmax_t size = std::filesystem::file_size(file, missing);
  if (missing || size == 0) return {};
  if (size > kMaxEmbeddedFilmBytes) return {.link = file.filename().string()};
  return {.bytes = read_file_whole(file)};
}

}  // namespace

Json panels_data(const FlightResult& result, const Table& trajectory, const Table& decisions, size_t max_points) {
  Json json = Json::array();
  for (const Panel& panel : all_panels(trajectory, decisions, result)) json.push_back(panel_json(panel, max_points));
  return json;
}

Json page_result(const RunResult& result) {
  Json json = to_json(result.info, result.flight);
  json["seed"] = std::to_string(result.info.seed);
  return json;
}

Json report_data(const ReportScenario& scenario, const RunResult& result, const Table& trajectory,
                 const Table& decisions, size_t max_points) {
  Json json;
  json["result"] = page_result(result);
  json["description"] = scenario.description;
  json["module"] = scenario.module;
  json["scene"] = scenario.scene;
  json["vehicle"] = scenario.vehicle;
  json["scenario_yaml"] = scenario.yaml;
  json["plan"] = plan_json(scenario, trajectory.numbers("down_m"));
  json["path"] = path_json(trajectory, decisions, max_points);
  json["panels"] = panels_data(result.flight, trajectory, decisions, max_points);
  return json;
}

void write_report(const std::filesystem::path& run_folder, const RunRecord& run,
                  const std::optional<std::filesystem::path>& against) {
  nlohmann::ordered_json data = report_data(describe_scenario(run), run.result, run.trajectory, run.decisions);
  data["map"] = run.map;
  data["references"] = references_json(run.scenario.checks);
  data["has_replay"] = std::filesystem::exists(run_folder / "replay.html");
  data["against"] = against ? against_json(run_folder, run, *against) : nullptr;
  write_file_whole(run_folder / "report.html", report_page(title(run), text(data), find_film(run_folder)));
}

}  // namespace hedgehop::sim
