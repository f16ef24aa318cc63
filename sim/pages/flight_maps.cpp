#include "sim/pages/flight_maps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/flight/json_reader.h"
#include "sim/pages/decimate.h"
#include "sim/pages/plan.h"
#include "sim/record/table.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPathToleranceM = 0.05;     // less than the width of a line on any map
constexpr double kOutlineToleranceM = 0.02;  // less than the radius of a trunk
constexpr size_t kMaxScenes = 24;            // each takes up to one second
constexpr size_t kTriedSeeds = 8;
constexpr size_t kMaxMapBytes = 3'000'000;  // limit for pages below 10 MB

/// Returns a key that is equal for equal configurations.
std::string config_key(const scenes::SceneConfig& scene) {
  Scenario only;
  only.scene = scene;
  return to_yaml(only);
}

/// Returns a key that is equal for scenes with equal maps.
std::string plan_key(const ScenePlan& plan) { return plan_data(plan, 0.0, 0.0).dump(); }

/// Simplifies the outlines of round bodies, because a page may have many maps.
void coarsen(ScenePlan& plan) {
  for (SolidOutline& footprint : plan.outlines) {
    std::vector<Eigen::Vector2d>& corners = footprint.corners_NE_m;
    if (corners.size() > 8) corners = simplified(corners, kOutlineToleranceM, corners.size());
  }
}

struct SeededFlights {
  uint64_t seed = 0;
  std::vector<size_t> flights;
};

/// Makes the plans of scenes and reuses equal ones.
class PlanMaker {
 public:
  explicit PlanMaker(std::vector<ScenePlan>& plans) : plans_(plans) {}

  /// Returns the index of the plan; none if the limit is reached.
  std::optional<size_t> make(const scenes::SceneConfig& config, uint64_t seed) {
    if (made_ == kMaxScenes || bytes_ > kMaxMapBytes) return {};
    ++made_;
    ScenePlan plan = scene_plan(build_scene(config, seed));
    coarsen(plan);
    const auto [entry, is_new] = known_.try_emplace(plan_key(plan), plans_.size());
    if (is_new) {
      bytes_ += entry->first.size();
      plans_.push_back(std::move(plan));
    }
    return entry->second;
  }

 private:
  std::vector<ScenePlan>& plans_;
  std::map<std::string, size_t> known_;
  size_t made_ = 0, bytes_ = 0;
};

int64_t centimeters(double meters) { return std::llround(meters * 100.0); }

Json path_steps(const std::vector<Eigen::Vector2d>& path) {
  Json steps = Json::array();
  int64_t north = 0, east = 0;
  for (const Eigen::Vector2d& p : path) {
    steps.push_back(centimeters(p.x()) - north);
    steps.push_back(centimeters(p.y()) - east);
    north = centimeters(p.x());
    east = centimeters(p.y());
  }
  return steps;
}

}  // namespace

std::optional<FlownPath> read_path(const std::filesystem::path& flight_folder, uint64_t seed, size_t max_points) {
  try {
    const Scenario scenario = load_scenario(flight_folder / "scenario.yaml");
    const Table trajectory(flight_folder / "trajectory.csv");
    const auto north = trajectory.numbers("north_m"), east = trajectory.numbers("east_m");
    const auto down = trajectory.numbers("down_m");
    FlownPath path{.scene = scenario.scene, .seed = scenario.world_seed.value_or(seed), .goal = scenario.goal};
    for (size_t i = 0; i < north.size(); ++i) path.p_NE_m.emplace_back(north[i], east[i]);
    path.p_NE_m = simplified(path.p_NE_m, kPathToleranceM, max_points);
    if (!down.empty()) {
      path.lowest_m = -*std::ranges::max_element(down);
      path.highest_m = -*std::ranges::min_element(down);
    }
    return path;
  } catch (const std::runtime_error&) {  // also InputError: a missing or incomplete folder has no path
    return {};
  }
}

FlightMaps flight_maps(const std::vector<std::optional<FlownPath>>& flights) {
  FlightMaps maps{.plans = {}, .map_of = std::vector<std::optional<size_t>>(flights.size())};
  std::map<std::string, std::vector<SeededFlights>> configs;
  std::vector<std::string> order;
  for (size_t i = 0; i < flights.size(); ++i) {
    if (!flights[i]) continue;
    const std::string key = config_key(flights[i]->scene);
    const auto [entry, is_new] = configs.try_emplace(key);
    if (is_new) order.push_back(key);
    auto seeded = std::ranges::find(entry->second, flights[i]->seed, &SeededFlights::seed);
    if (seeded == entry->second.end()) seeded = entry->second.insert(seeded, {.seed = flights[i]->seed, .flights = {}});
    seeded->flights.push_back(i);
  }

  PlanMaker maker(maps.plans);
  for (const std::string& key : order) {
    const std::vector<SeededFlights>& seeds = configs.at(key);
    std::optional<size_t> shared;
    bool all_share = true;
    for (size_t k = 0; k < seeds.size(); ++k) {
      const scenes::SceneConfig& config = flights[seeds[k].flights.front()]->scene;
      std::optional<size_t> map = shared;
      if (k < kTriedSeeds || !all_share) map = maker.make(config, seeds[k].seed);
      if (k == 0) shared = map;
      all_share = all_share && map == shared;
      for (const size_t flight : seeds[k].flights) maps.map_of[flight] = map;
    }
  }
  return maps;
}

Json paths_data(const FlightMaps& maps, const std::vector<std::optional<FlownPath>>& flights) {
  Json json{{"maps", Json::array()}, {"map", Json::array()}, {"path", Json::array()}, {"goal", Json::array()}};
  for (size_t map = 0; map < maps.plans.size(); ++map) {
    double lowest_m = INFINITY, highest_m = -INFINITY;
    for (size_t i = 0; i < flights.size(); ++i) {
      if (maps.map_of[i] != map) continue;
      lowest_m = std::min(lowest_m, flights[i]->lowest_m);
      highest_m = std::max(highest_m, flights[i]->highest_m);
    }
    json["maps"].push_back(plan_data(maps.plans[map], lowest_m, highest_m));
  }
  for (size_t i = 0; i < flights.size(); ++i) {
    const auto& flight = flights[i];
    json["map"].push_back(maps.map_of[i] ? static_cast<int64_t>(*maps.map_of[i]) : -1);
    json["path"].push_back(flight ? path_steps(flight->p_NE_m) : Json::array());
    json["goal"].push_back(flight && flight->goal ? Json{milli(flight->goal->north_m), milli(flight->goal->east_m),
                                                         milli(flight->goal->radius_m)}
                                                  : Json(nullptr));
  }
  return json;
}

}  // namespace hedgehop::sim
