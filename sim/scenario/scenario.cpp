#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/config/include.h"
#include "sim/config/outline_texts.h"
#include "sim/config/reader.h"
#include "sim/libm/random.h"
#include "sim/scenario/file_kind.h"
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

constexpr std::string_view kRenderer = "its name is now 'renderer'";
constexpr std::string_view kScheme = "it was removed; `scheme: simple` is now `module: zig_zag`";
constexpr std::string_view kFocal = "the focal lengths are 'focal_x' and 'focal_y'";
constexpr std::string_view kCenter = "the optical axis is at 'center_u' and 'center_v'";
constexpr FormerKey kFormerKeys[] = {
    {.path = "drawing", .key = "gl", .advice = kRenderer},
    {.path = "drawing", .key = "context", .advice = kRenderer},
    {.path = "avoidance", .key = "law", .value = "printed", .advice = "its name is now 'published'"},
    {.path = "avoidance", .key = "law", .value = "ours", .advice = "its name is now 'modified'"},
    {.path = "takeover.avoidance", .key = "law", .value = "printed", .advice = "its name is now 'published'"},
    {.path = "takeover.avoidance", .key = "law", .value = "ours", .advice = "its name is now 'modified'"},
    {.path = "avoidance", .key = "scheme", .beside = "spiral_angle", .advice = kScheme},
    {.path = "avoidance", .key = "front_end", .beside = "source", .advice = "its name is now 'source'"},
    {.path = "avoidance", .key = "sight", .beside = "depth", .advice = "its name is now 'depth'"},
    {.path = "avoidance", .key = "rows", .beside = "sections", .advice = "its name is now 'sections'"},
    {.path = "avoidance", .key = "cols", .beside = "sections", .advice = "its name is now 'sections'"},
    {.path = "avoidance", .key = "passed", .beside = "passed_radius", .advice = "its name is now 'passed_radius'"},
    {.path = "avoidance.map", .key = "young_misses", .advice = "its name is now 'unconfirmed_misses'"},
    {.path = "rig.cameras.*", .key = "fx", .advice = kFocal},
    {.path = "rig.cameras.*", .key = "fy", .advice = kFocal},
    {.path = "rig.cameras.*", .key = "cx", .advice = kCenter},
    {.path = "rig.cameras.*", .key = "cy", .advice = kCenter},
    {.path = "rig.stereo.*", .key = "fx", .advice = kFocal},
    {.path = "rig.stereo.*", .key = "fy", .advice = kFocal},
    {.path = "rig.stereo.*", .key = "cx", .advice = kCenter},
    {.path = "rig.stereo.*", .key = "cy", .advice = kCenter},
    {.key = "chance",
     .advice = "it was removed with `hedgehop estimate`; to bound a rate, use `hedgehop batch --until`"},
};

/// Makes the paths of imports, maps, tables of motion and heightmaps absolute, from the folder of the file that names
/// them, so that the written scenario can be read from any folder.
void resolve_files(scenes::SceneConfig& scene, const Node& root) {
  scenes::SceneAdditions& added = std::visit(
      [](auto& chosen) -> auto& { return chosen.added; }, scene);
  const auto resolve = [&root](std::string& file, const std::string& key) {
    if (file.empty()) return;
    const std::filesystem::path folder = std::filesystem::path(position_of(root, key).file).parent_path();
    file = std::filesystem::absolute(folder / file).lexically_normal().string();
  };
  for (size_t k = 0; k < added.imports.size(); ++k)
    resolve(added.imports[k].file, "scene.imports." + std::to_string(k) + ".file");
  const auto resolve_motion = [&](scenes::Motion& motion, const std::string& key) {
    if (auto* const table = std::get_if<scenes::TableMotion>(&motion)) resolve(table->file, key + ".file");
  };
  for (size_t k = 0; k < added.movers.size(); ++k)
    resolve_motion(added.movers[k].motion, "scene.movers." + std::to_string(k) + ".motion");
  if (auto* const balloon = std::get_if<scenes::worlds::BalloonConfig>(&scene))
    resolve_motion(balloon->motion, "scene.motion");
  if (added.terrain) resolve(added.terrain->heightmap, "scene.terrain.heightmap");
  if (auto* map = std::get_if<scenes::worlds::MapConfig>(&scene)) {
    resolve(map->osm, "scene.osm");
    resolve(map->terrain, "scene.terrain");
  }
}

/// Makes the paths of files in the command that starts an autopilot absolute.
void resolve_files(std::optional<LinkConfig>& link, const Node& root) {
  if (!link) return;
  const std::filesystem::path folder = std::filesystem::path(position_of(root, "link").file).parent_path();
  for (std::string& word : std::visit(
           [](auto& chosen) -> auto& { return chosen.start.command; }, *link)) {
    std::error_code ignored;
    const std::filesystem::path file = std::filesystem::absolute(folder / word).lexically_normal();
    if (std::filesystem::is_regular_file(file, ignored)) word = file.string();
  }
}

/// Makes the paths of reference trajectories absolute. @param folder  of the scenario, for `--set`.
void resolve_files(std::vector<CheckConfig>& checks, const Node& root, const std::filesystem::path& folder) {
  for (size_t i = 0; i < checks.size(); ++i) {
    auto* const path = std::get_if<PathToleranceCheck>(&checks[i]);
    if (!path) continue;
    const SourcePosition at = position_of(root, fmt::format("checks.{}.reference", i));
    const std::filesystem::path from = at.line > 0 ? std::filesystem::path(at.file).parent_path() : folder;
    path->reference = std::filesystem::absolute(from / path->reference).lexically_normal().string();
  }
}

/// Refuses a file of another kind by one error that names the kind, instead of an error per key.
void require_scenario(const Node& root, ErrorList& errors) {
  if (root.incomplete) errors.throw_if_any();  // the missing file may have the keys of its kind
  for (const std::string_view key : {"scene", "vehicle", "start", "avoidance"}) {
    if (root.find(key)) return;
  }
  if (const std::string kind = file_kind(root); !kind.empty()) {
    errors.add(root.position, "is not a scenario but " + kind);
    errors.throw_if_any();
  }
  errors.add(root.position,
             "is no file of Hedgehop: it lacks all keys of a scenario (scene, vehicle, start, avoidance), a campaign "
             "(flights or leaderboard), a sweep or search (parameters), or a paper (rows)");
  errors.throw_if_any();
}

/// @param file  source of `root`. @param read  files read so far.
LoadedScenario load_flight(Node root, const std::filesystem::path& file, std::span<const std::string> overrides,
                           std::optional<uint64_t> seed, ErrorList& errors, std::set<std::filesystem::path>& read) {
  if (root.kind != Node::Kind::map) errors.throw_if_any();
  require_scenario(root, errors);
  apply_overrides(root, overrides, file, errors, read);

  Scenario scenario;
  read_struct(root, "", "", scenario, errors);
  errors.throw_if_any();
  if (seed) scenario.seed = *seed;
  resolve_files(scenario.scene, root);
  resolve_files(scenario.link, root);
  resolve_files(scenario.checks, root, file.parent_path());
  Validation found = validate(scenario);
  for (const FieldError& error : found.errors) errors.add(position_of(root, error.path), error.text());
  errors.throw_if_any();
  Inputs inputs = inputs_of(scenario, read, file.parent_path());
  return {std::move(scenario), *std::move(found.parts), std::move(inputs),
          std::make_shared<const Node>(std::move(root))};
}

}  // namespace

LoadedScenario load_flight(const std::filesystem::path& file, std::span<const std::string> overrides,
                           std::optional<uint64_t> seed) {
  ErrorList errors("scenario", kFormerKeys);
  std::set<std::filesystem::path> read;
  Node root = load_tree(file, errors, read);
  return load_flight(std::move(root), file, overrides, seed, errors, read);
}

LoadedScenario load_flight_text(const std::string& yaml, std::span<const std::string> overrides,
                                std::optional<uint64_t> seed) {
  constexpr const char* kName = "scenario text";
  ErrorList errors("scenario", kFormerKeys);
  std::set<std::filesystem::path> read;
  Node root = parse_tree(yaml, kName, errors, read);
  return load_flight(std::move(root), kName, overrides, seed, errors, read);
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return load_flight(file, overrides).scenario;
}

dynamics::VehicleConfig load_vehicle(const std::filesystem::path& file) {
  ErrorList errors("vehicle");
  const Node root = load_tree(file, errors);
  if (root.kind != Node::Kind::map) errors.throw_if_any();
  if (root.find("vehicle")) {
    throw InputError(fmt::format(
        "{}: is a scenario; a vehicle file is needed, such as the one that its key 'vehicle' uses", file.string()));
  }
  dynamics::VehicleConfig vehicle;
  read_value(root, "", {.meaning = "a vehicle"}, vehicle, errors);
  errors.throw_if_any();
  try {
    dynamics::Vehicle{vehicle};  // throws with the reason if the vehicle cannot fly
  } catch (const fields::InvalidField& error) {
    const FieldError fault = field_error("", error);
    throw InputError(fmt::format("{}: {}", position_of(root, fault.path).text(), fault.text()));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  return vehicle;
}

std::string to_yaml(const Scenario& scenario) { return yaml_text(outline_fields(scenario)); }

std::string json_schema() { return schema_text(outline_fields(Scenario{}), "Hedgehop scenario"); }

}  // namespace hedgehop::sim
