#include "sim/pages/report.h"

#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "sim/pages/plan_data.h"
#include "sim/pages/replay_data.h"
#include "sim/pages/report_data.h"
#include "sim/pages/report_page.h"
#include "sim/record/json_number.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

/// A larger film stays beside the report: pages of more than this take seconds to open.
constexpr uintmax_t kLargestFilmInside = 40'000'000;

/// The name under which a choice stands in a scenario.
template <class Choice>
std::string chosen(const Choice& choice) {
  return std::visit([](const auto& c) { return std::string(std::decay_t<decltype(c)>::kName); }, choice);
}

ReportScenario describe_scenario(const RunRecord& run) {
  const Scenario& scenario = run.scenario;
  ReportScenario result{.description = scenario.description,
                        .module = std::string(scenario.avoidance.name()),
                        .scene = chosen(scenario.scene),
                        .vehicle = chosen(scenario.vehicle),
                        .yaml = run.scenario_yaml,
                        .plan = scene_plan(*run.scene)};
  if (scenario.goal) {
    result.goal = PlanGoal{{scenario.goal->north_m, scenario.goal->east_m}, scenario.goal->radius_m};
  }
  return result;
}

std::string title(const RunRecord& run) { return run.result.value("scenario", "flight"); }

/// A module's words may be no UTF-8.
std::string text(const nlohmann::ordered_json& data) {
  return data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
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

void write_report(const std::filesystem::path& run_folder, const RunRecord& run) {
  nlohmann::ordered_json data = report_data(describe_scenario(run), run.result, run.trajectory, run.decisions);
  data["map"] = run.map;
  data["has_replay"] = std::filesystem::exists(run_folder / "replay.html");
  write_file_whole(run_folder / "report.html", report_page(title(run), text(data), find_film(run_folder)));
}

void write_replay(const std::filesystem::path& run_folder, const RunRecord& run) {
  nlohmann::ordered_json data;
  data["result"] = run.result;
  data["has_report"] = std::filesystem::exists(run_folder / "report.html");
  data["scene"] = replay_scene(*run.scene, run.result.at("flight_time_s").get<double>());
  data["hull"] = replay_hull(dynamics::hull(run.scenario.vehicle));
  data["path"] = replay_path(run.trajectory);
  data["statuses"] = replay_statuses(run.decisions);
  data["has_film"] = std::filesystem::exists(run_folder / "video.webm");
  data["goal"] = nullptr;
  if (const auto& goal = run.scenario.goal) {
    data["goal"] = {milli(goal->north_m), milli(goal->east_m), milli(-goal->altitude_m), milli(goal->radius_m)};
  }
  write_file_whole(run_folder / "replay.html", replay_page(title(run), text(data)));
}

}  // namespace hedgehop::sim
