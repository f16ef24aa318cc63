#include "sim/pages/replay.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "dynamics/vehicle.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/flight/json_reader.h"
#include "sim/pages/replay_data.h"
#include "sim/pages/replay_images.h"
#include "sim/pages/replay_surfaces.h"
#include "sim/pages/report.h"
#include "sim/pages/report_page.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kPanelPoints = 800;      // of each plot
constexpr double kLongestLiveS = 3600.0;  // of the motion of moving obstacles in a live view

/// Returns the data that do not depend on the flight.
Json still_data(const Scenario& scenario, const scenes::Scene& scene, double end_s) {
  Json data;
  data["scene"] = replay_scene(scene, end_s);
  data["surfaces"] = replay_surfaces(scene, scenario.drawing.shadows);
  data["cameras"] = replay_cameras(scenario.rig);
  data["hull"] = replay_hull(dynamics::hull(scenario.vehicle));
  const auto mark = [](const GoalConfig& goal) -> Json {
    return {milli(goal.north_m), milli(goal.east_m), milli(-goal.altitude_m), milli(goal.radius_m)};
  };
  data["route"] = Json::array();
  for (const GoalConfig& waypoint : scenario.route) data["route"].push_back(mark(waypoint));
  data["goal"] = scenario.goal ? mark(*scenario.goal) : Json(nullptr);
  return data;
}

/// Returns the JSON text. Texts of a module may be invalid UTF-8.
std::string replay_json(const Json& data) { return json_text(data); }

}  // namespace

std::string write_replay(const std::filesystem::path& run_folder, const RunRecord& run) {
  Json data = still_data(run.scenario, *run.scene, run.result.flight.flight_time_s);
  data["live"] = false;
  data["result"] = page_result(run.result);
  data["has_report"] = std::filesystem::exists(run_folder / "report.html");
  data["has_film"] = std::filesystem::exists(run_folder / "video.webm");
  data["path"] = replay_path(run.trajectory);
  data["statuses"] = replay_statuses(run.decisions);
  data["panels"] = panels_data(run.result.flight, run.trajectory, run.decisions, kPanelPoints);
  data["map"] = run.map;
  const CameraFilm film = camera_film(run, run_folder);
  data["film"] = base64(film.bytes);
  data["film_rate_hz"] = film.rate_hz;
  write_file_whole(run_folder / "replay.html", replay_page(run.result.info.scenario, replay_json(data)));
  return film.fault;
}

std::string live_page(const Scenario& scenario, const scenes::Scene& scene) {
  Json data = still_data(scenario, scene, std::min(scenario.duration_s, kLongestLiveS));
  data["live"] = true;
  data["result"] = {{"scenario", scenario.name},
                    {"seed", std::to_string(scenario.seed)},
                    {"version", std::string(version())},
                    {"build", std::string(build_identity())},
                    {"outcome", "in flight"},
                    {"flight_time_s", 0.0},
                    {"goal_distance_m", scenario.goal ? Json(0.0) : Json(nullptr)},
                    {"closest_obstacle", nullptr}};
  data["has_report"] = data["has_film"] = false;
  data["path"] = Json::object();
  for (const char* key :
       {"t_s", "north_m", "east_m", "down_m", "clearance_m", "roll_rad", "pitch_rad", "yaw_rad", "speed_mps"}) {
    data["path"][key] = Json::array();
  }
  data["statuses"] = data["panels"] = Json::array();
  data["map"] = nullptr;
  data["film"] = "";
  data["film_rate_hz"] = 0.0;
  return replay_page(scenario.name, replay_json(data));
}

}  // namespace hedgehop::sim
