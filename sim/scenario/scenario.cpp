#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/config/include.h"
#include "sim/config/reader.h"
#include "sim/config/schema.h"
#include "sim/config/writer.h"
#include "sim/libm/random.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim {

Eigen::Vector3d StartConfig::draw_p_WB(uint64_t seed) const {
  Random random(seed);
  Eigen::Vector2d in_disc;
  do {
    in_disc.x() = uniform(random, -1.0, 1.0);
    in_disc.y() = uniform(random, -1.0, 1.0);
  } while (in_disc.squaredNorm() > 1.0);
  return p_WB() + spread_m * Eigen::Vector3d(in_disc.x(), in_disc.y(), 0.0);
}

namespace {

// Imported files are seen from the folder of the file that names them; from then on their paths are whole, so that the
// scenario reads back anywhere.
void find_imports(scenes::SceneConfig& scene, const Node& root) {
  std::vector<scenes::mesh::ImportConfig>& imports = std::visit(
      [](auto& chosen) -> auto& { return chosen.added.imports; }, scene);
  for (size_t k = 0; k < imports.size(); ++k) {
    const Place place = place_of(root, "scene.imports." + std::to_string(k) + ".file");
    const std::filesystem::path folder = std::filesystem::path(place.file).parent_path();
    imports[k].file = std::filesystem::absolute(folder / imports[k].file).lexically_normal().string();
  }
}

/// Says of a file of another kind what it is, in place of all keys that it lacks and has.
void require_scenario(const Node& root, Faults& faults) {
  struct Kind {
    std::string_view key, words;  ///< a key that all of the kind have and no scenario
  };
  static constexpr Kind kKinds[] = {{"question", "a plan, for `hedgehop batch --plan`"},
                                    {"rows", "a paper, for `hedgehop reproduce`"},
                                    {"flights", "a campaign, for `hedgehop batch`"},
                                    {"parameters", "a sweep or a search, for `hedgehop sweep` or `hedgehop falsify`"},
                                    {"mass", "a vehicle; a scenario names it: vehicle: {use: FILE}"},
                                    {"cameras", "a rig; a scenario names it: rig: {use: FILE}"},
                                    {"stereo", "a rig; a scenario names it: rig: {use: FILE}"},
                                    {"module", "a module's parameters; a scenario names them: avoidance: {use: FILE}"}};
  if (root.incomplete || root.find("scene") || root.find("vehicle") || root.find("avoidance")) return;
  for (const auto& [key, words] : kKinds) {
    if (!root.find(key)) continue;
    faults.add(root.place, fmt::format("is no scenario but {}", words));
    faults.raise();
  }
}

/// @param file  that `root` comes from. @param read  files read so far.
LoadedScenario load_flight(Node root, const std::filesystem::path& file, std::span<const std::string> overrides,
                           std::optional<uint64_t> seed, Faults& faults, std::set<std::filesystem::path>& read) {
  if (root.kind != Node::Kind::map) faults.raise();
  require_scenario(root, faults);
  apply_overrides(root, overrides, file, faults, read);

  Scenario scenario;
  read_struct(root, "", "", scenario, faults);
  faults.raise();
  if (seed) scenario.seed = *seed;
  mount_stereo_pairs(scenario.rig);
  mount_sensor(scenario.rig);
  find_imports(scenario.scene, root);
  for (CheckConfig& check : scenario.checks) {
    if (auto* path = std::get_if<PathToleranceCheck>(&check)) {
      path->reference = std::filesystem::absolute(file.parent_path() / path->reference).lexically_normal().string();
    }
  }
  std::optional<FlightParts> parts = validate(scenario, root, faults);
  faults.raise();
  Inputs inputs = inputs_of(scenario, read, file.parent_path());
  return {std::move(scenario), *std::move(parts), std::move(inputs), std::make_shared<const Node>(std::move(root))};
}

}  // namespace

LoadedScenario load_flight(const std::filesystem::path& file, std::span<const std::string> overrides,
                           std::optional<uint64_t> seed) {
  Faults faults;
  std::set<std::filesystem::path> read;
  Node root = load_tree(file, faults, read);
  return load_flight(std::move(root), file, overrides, seed, faults, read);
}

LoadedScenario load_flight_text(const std::string& yaml, std::span<const std::string> overrides,
                                std::optional<uint64_t> seed) {
  constexpr const char* kName = "scenario text";
  Faults faults;
  std::set<std::filesystem::path> read;
  Node root = parse_tree(yaml, kName, faults, read);
  return load_flight(std::move(root), kName, overrides, seed, faults, read);
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return load_flight(file, overrides).scenario;
}

dynamics::VehicleConfig load_vehicle(const std::filesystem::path& file) {
  Faults faults;
  const Node root = load_tree(file, faults);
  if (root.kind != Node::Kind::map) faults.raise();
  dynamics::VehicleConfig vehicle;
  read_value(root, "", {.meaning = "a vehicle"}, vehicle, faults);
  faults.raise();
  return vehicle;
}

std::string to_yaml(const Scenario& scenario) { return yaml_text(outline_fields(scenario)); }

std::string json_schema() { return schema_text(outline_fields(Scenario{}), "Hedgehop scenario"); }

}  // namespace hedgehop::sim
