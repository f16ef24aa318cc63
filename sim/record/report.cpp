#include "sim/record/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <variant>

#include "scenes/generators.h"
#include "sim/loop/random_stream.h"
#include "sim/record/plan_data.h"
#include "sim/record/replay_data.h"
#include "sim/record/report_data.h"
#include "sim/record/report_page.h"
#include "sim/record/whole_file.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {
namespace {

/// A larger film stays beside the report: pages of more than this take seconds to open.
constexpr uintmax_t kLargestFilmInside = 40'000'000;

/// The name under which a choice stands in a scenario.
template <class Choice>
std::string chosen(const Choice& choice) {
  return std::visit([](const auto& c) { return std::string(std::decay_t<decltype(c)>::kName); }, choice);
}

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
  try {
    return nlohmann::ordered_json::parse(read_file_whole(file));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

ReportScenario describe_scenario(const Scenario& scenario, uint64_t seed, std::string yaml) {
  const scenes::Scene scene = scenes::make_scene(scenario.scene, stream_seed(seed, kSceneStream));
  ReportScenario result{.description = scenario.description,
                        .module = chosen(scenario.avoidance),
                        .scene = chosen(scenario.scene),
                        .vehicle = chosen(scenario.vehicle),
                        .yaml = std::move(yaml),
                        .plan = scene_plan(scene)};
  if (scenario.goal) {
    result.goal = PlanGoal{{scenario.goal->north_m, scenario.goal->east_m}, scenario.goal->radius_m};
  }
  return result;
}

PageFilm find_film(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / "video.webm";
  std::error_code missing;
  const uintmax_t size = std::filesystem::file_size(file, missing);
  if (missing || size == 0) return {};
  if (size > kLargestFilmInside) return {.link = file.filename().string()};
  return {.bytes = read_file_whole(file)};
}

}  // namespace

void write_report(const std::filesystem::path& run_folder) {
  const nlohmann::ordered_json result = read_json(run_folder / "result.json");
  const CsvTable trajectory(run_folder / "trajectory.csv"), decisions(run_folder / "decisions.csv");
  const std::filesystem::path scenario_file = run_folder / "scenario.yaml";
  const ReportScenario scenario = describe_scenario(load_scenario(scenario_file), result.at("seed").get<uint64_t>(),
                                                    read_file_whole(scenario_file));
  nlohmann::ordered_json data = report_data(scenario, result, trajectory, decisions);
  const std::filesystem::path map_file = run_folder / "map.json";
  data["map"] = std::filesystem::exists(map_file) ? read_json(map_file) : nlohmann::ordered_json(nullptr);
  data["has_replay"] = std::filesystem::exists(run_folder / "replay.html");
  const std::string title = result.value("scenario", "flight");
  write_file_whole(run_folder / "report.html", report_page(title, data.dump(), find_film(run_folder)));
}

void write_replay(const std::filesystem::path& run_folder) {
  const nlohmann::ordered_json result = read_json(run_folder / "result.json");
  const CsvTable trajectory(run_folder / "trajectory.csv");
  const Scenario scenario = load_scenario(run_folder / "scenario.yaml");
  const uint64_t seed = result.at("seed").get<uint64_t>();
  const scenes::Scene scene = scenes::make_scene(scenario.scene, stream_seed(seed, kSceneStream));

  nlohmann::ordered_json data;
  data["result"] = result;
  data["has_report"] = std::filesystem::exists(run_folder / "report.html");
  data["scene"] = replay_scene(scene, result.at("flight_time_s").get<double>());
  data["hull"] = replay_hull(dynamics::hull(scenario.vehicle));
  data["path"] = replay_path(trajectory);
  data["goal"] = nullptr;
  if (const auto& goal = scenario.goal) {
    data["goal"] = {milli(goal->north_m), milli(goal->east_m), milli(-goal->altitude_m), milli(goal->radius_m)};
  }
  write_file_whole(run_folder / "replay.html", replay_page(result.value("scenario", "flight"), data.dump()));
}

}  // namespace hedgehop::sim
