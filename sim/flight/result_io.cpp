#include "sim/flight/result_io.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/fields/quantities.h"
#include "sim/flight/json_reader.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Keys of the result and of its objects.
const RenamedKey kRenamedKeys[] = {
    {"least_clearance_m", "min_clearance_m"}, {"drawn_by", "renderer"}, {"least_gap_m", "min_gap_m"}};

Json approach_json(const ClosestApproach& approach) {
  if (!std::isfinite(approach.distance_m)) return nullptr;
  const Eigen::Vector3d& p = approach.p_WB_true;
  return Json{{"what", approach.what},
              {"distance_m", json_number(approach.distance_m)},
              {"t_s", json_number(approach.t_s)},
              {"north_m", json_number(p.x())},
              {"east_m", json_number(p.y())},
              {"altitude_m", json_number(-p.z())}};
}

Json stage_json(const StageTime& time) {
  return Json{{"median", json_number(time.median_ms)}, {"p95", json_number(time.p95_ms)}};
}

Json checks_json(const std::vector<CheckResult>& results) {
  Json list = Json::array();
  for (const CheckResult& check : results) {
    list.push_back(Json{{"name", check.name},
                        {"passed", check.passed},
                        {"value", json_number(check.value)},
                        {"limit", json_number(check.limit)},
                        {"unit", check.unit},
                        {"must", check.must},
                        {"t_s", json_number(check.t_s.value_or(NAN))},
                        {"cause", check.cause}});
  }
  return list;
}

ClosestApproach approach_from(const JsonReader& result, const char* key, const char* distance) {
  ClosestApproach approach{.distance_m = result.number(distance, kInfinity), .what = {}};
  if (!result.has(key) || result.json().at(key).is_null()) return approach;
  const JsonReader closest = result.object(key);
  approach.distance_m = closest.number("distance_m", kInfinity);
  approach.t_s = closest.number("t_s");
  approach.what = closest.text("what");
  approach.p_WB_true = {closest.number("north_m"), closest.number("east_m"), -closest.number("altitude_m")};
  return approach;
}

StageTime stage_from(const JsonReader& result, const char* key) {
  const JsonReader stage = result.object(key);
  return {stage.number("median"), stage.number("p95")};
}

std::string_view relation_from(const JsonReader& check) {
  constexpr std::array<std::string_view, 3> kRelations = {"<=", ">=", ">"};
  if (!check.has("must")) return kRelations[0];
  const std::string text = check.text("must");
  for (const std::string_view relation : kRelations) {
    if (relation == text) return relation;
  }
  check.refuse("must");
}

std::vector<CheckResult> checks_from(const JsonReader& result) {
  std::vector<CheckResult> checks;
  for (const Json& json : result.array("checks")) {
    const JsonReader check(json, fmt::format("checks.{}", checks.size()));
    check.require({"name", "passed", "unit"});
    checks.push_back({.name = check.text("name"),
                      .passed = check.flag("passed"),
                      .value = check.number("value"),
                      .limit = check.number("limit"),
                      .unit = check.text("unit"),
                      .must = relation_from(check),
                      .t_s = check.optional_number("t_s"),
                      .cause = check.has("cause") ? check.text("cause") : ""});
  }
  return checks;
}

Json link_json(const LinkFigures& link) {
  return Json{{"kind", link.kind},
              {"peer", link.peer},
              {"frames", link.frames},
              {"repeated", link.repeated},
              {"old", link.old},
              {"resent", link.resent},
              {"missed", link.missed},
              {"unanswered", link.unanswered},
              {"malformed", link.malformed},
              {"strangers", link.strangers},
              {"start_tick", link.start_tick ? Json(*link.start_tick) : Json(nullptr)}};
}

std::optional<LinkFigures> link_from(const JsonReader& result) {
  if (!result.has("link")) return std::nullopt;
  const JsonReader link = result.object("link");
  LinkFigures figures{.kind = link.text("kind"), .peer = link.text("peer")};
  figures.frames = link.count("frames");
  figures.repeated = link.count("repeated");
  figures.old = link.count("old");
  figures.resent = link.count("resent");
  figures.missed = link.count("missed");
  figures.unanswered = link.count("unanswered");
  figures.malformed = link.count("malformed");
  figures.strangers = link.count("strangers");
  if (link.has("start_tick") && !link.json().at("start_tick").is_null()) figures.start_tick = link.count("start_tick");
  figures.waited_s = result.object("time").number("link_wait_s");
  return figures;
}

std::vector<MetricValue> metrics_from(const JsonReader& result) {
  const JsonReader values = result.object("metrics"), units = result.object("metric_units"),
                   kinds = result.object("metric_kinds");
  std::vector<MetricValue> metrics;
  for (const auto& [name, value] : values.json().items()) {
    MetricValue& metric = metrics.emplace_back();
    metric.name = name;
    metric.value = values.number(name.c_str());
    metric.unit = units.text(name.c_str());
    const std::string kind = kinds.text(name.c_str());
    for (const FigureKind known : {FigureKind::module, FigureKind::wall_time}) {
      if (kind == to_string(known)) metric.kind = known;
    }
  }
  return metrics;
}

Outcome outcome_from(const JsonReader& result) {
  const std::optional<Outcome> outcome = parse_outcome(result.text("outcome"));
  if (!outcome) result.refuse("outcome");
  return *outcome;
}

RunInfo info_from(const JsonReader& result) {
  RunInfo info{.scenario = result.text("scenario"),
               .seed = result.unsigned_number("seed"),
               .version = result.text("version"),
               .build = result.text("build"),
               .inputs = {},
               .scenario_file = raw_name(result.text("scenario_file")),
               .command_line = result.text("command_line"),
               .scenario_yaml = {}};
  const JsonReader inputs = result.object("inputs");
  for (const auto& [file, hash] : inputs.json().items()) info.inputs[raw_name(file)] = inputs.text(file.c_str());
  return info;
}

}  // namespace

Json to_json(const RunInfo& info, const FlightResult& result) {
  const ClosestApproach& closest = closest_approach(result);
  Json json;
  json["scenario"] = info.scenario;
  json["seed"] = info.seed;
  json["version"] = info.version;
  json["build"] = info.build;
  json["inputs"] = Json::object();
  for (const auto& [file, hash] : info.inputs) json["inputs"][name_text(file)] = hash;
  json["scenario_file"] = name_text(info.scenario_file);
  json["command_line"] = info.command_line;
  json["outcome"] = std::string(to_string(result.outcome));
  json["cause"] = result.cause;
  json["goal_missed_unchecked"] = result.goal_missed_unchecked;
  json["truth_used"] = result.truth_used;
  json["failures"] = result.failures;
  json["physics_rate_hz"] = result.physics_rate_hz;
  json["flight_time_s"] = json_number(result.flight_time_s);
  json["path_length_m"] = json_number(result.path_length_m);
  json["min_clearance_m"] = json_number(closest.distance_m);
  json["min_clearance_time_s"] = std::isfinite(closest.distance_m) ? json_number(closest.t_s) : Json(nullptr);
  json["min_obstacle_clearance_m"] = json_number(result.closest_obstacle.distance_m);
  json["min_ground_clearance_m"] = json_number(result.closest_ground.distance_m);
  json["closest_obstacle"] = approach_json(result.closest_obstacle);
  json["closest_ground"] = approach_json(result.closest_ground);
  json["mean_speed_mps"] = json_number(result.mean_speed_mps);
  json["goal_distance_m"] = json_number(result.goal_distance_m.value_or(NAN));
  json["decisions"] = result.decisions;
  json["decision_ms"] = stage_json(result.decision_ms);
  json["render_ms"] = stage_json(result.render_ms);
  json["velocimeter_ms"] = stage_json(result.velocimeter_ms);
  json["physics_ms"] = stage_json(result.physics_ms);
  json["realtime_factor"] = json_number(result.realtime_factor);
  json["wall_s"] = json_number(result.wall_s);
  json["checks"] = checks_json(result.checks);
  json["trajectory_hash"] = result.trajectory_hash;
  json["libraries"] = Json{{"images", result.libraries.images},
                           {"functions", result.libraries.functions},
                           {"others", result.libraries.others},
                           {"renderer", result.libraries.renderer}};
  json["scene"] = Json{{"obstacles", result.scene.solids},
                       {"min_gap_m", json_number(result.scene.smallest_gap_m)},
                       {"median_gap_m", json_number(result.scene.median_gap_m)},
                       {"covered_share", json_number(result.scene.covered_share)},
                       {"density_per_m2", json_number(result.scene.density_pm2)}};
  if (result.link) {
    json["link"] = link_json(*result.link);
    json["time"] = Json{{"link_wait_s", json_number(result.link->waited_s)}};
  }
  for (const char* key : {"metrics", "metric_units", "metric_kinds"}) json[key] = Json::object();
  for (const MetricValue& metric : result.metrics) {
    json["metrics"][metric.name] = json_number(metric.value);
    json["metric_units"][metric.name] = metric.unit;
    json["metric_kinds"][metric.name] = std::string(to_string(metric.kind));
  }
  return json;
}

RunResult result_from_json(const Json& json) {
  const JsonReader result(json, "");
  result.refuse_renamed(kRenamedKeys);
  result.require({"scenario", "version", "build", "outcome", "trajectory_hash", "seed", "metrics", "checks",
                  "flight_time_s", "min_obstacle_clearance_m"});
  for (const char* derived : {"min_clearance_m", "min_clearance_time_s"}) result.optional_number(derived);
  RunResult run{.info = info_from(result), .flight = {}};
  FlightResult& flight = run.flight;
  flight.outcome = outcome_from(result);
  flight.cause = result.text("cause");
  flight.goal_missed_unchecked = result.has("goal_missed_unchecked") && result.flag("goal_missed_unchecked");
  flight.truth_used = result.texts("truth_used");
  flight.failures = result.texts("failures");
  flight.physics_rate_hz = result.count("physics_rate_hz");
  flight.flight_time_s = result.finite_number("flight_time_s");
  flight.path_length_m = result.number("path_length_m");
  flight.mean_speed_mps = result.number("mean_speed_mps");
  flight.closest_obstacle = approach_from(result, "closest_obstacle", "min_obstacle_clearance_m");
  flight.closest_ground = approach_from(result, "closest_ground", "min_ground_clearance_m");
  flight.goal_distance_m = result.optional_number("goal_distance_m");
  flight.decisions = result.count("decisions");
  flight.decision_ms = stage_from(result, "decision_ms");
  flight.render_ms = stage_from(result, "render_ms");
  flight.velocimeter_ms = stage_from(result, "velocimeter_ms");
  flight.physics_ms = stage_from(result, "physics_ms");
  flight.realtime_factor = result.number("realtime_factor");
  flight.wall_s = result.number("wall_s");
  flight.checks = checks_from(result);
  flight.trajectory_hash = result.text("trajectory_hash");
  const JsonReader libraries = result.object("libraries");
  libraries.refuse_renamed(kRenamedKeys);
  flight.libraries = {libraries.text("images"), libraries.text("functions"), libraries.text("others"),
                      libraries.text("renderer")};
  flight.metrics = metrics_from(result);
  const JsonReader scene = result.object("scene");
  scene.refuse_renamed(kRenamedKeys);
  flight.scene = {.solids = static_cast<size_t>(scene.count("obstacles")),
                  .smallest_gap_m = scene.number("min_gap_m", kInfinity),
                  .median_gap_m = scene.number("median_gap_m", kInfinity),
                  .covered_share = scene.number("covered_share"),
                  .density_pm2 = scene.number("density_per_m2")};
  flight.link = link_from(result);
  return run;
}

std::string result_json(const RunInfo& info, const FlightResult& result) {
  return json_text(to_json(info, result), 2) + "\n";
}

RunResult read_result(const std::filesystem::path& file) {
  const Json json = read_json(file);
  try {
    return result_from_json(json);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: no result of a flight: {}", file.string(), error.errors().front()));
  }
}

}  // namespace hedgehop::sim
