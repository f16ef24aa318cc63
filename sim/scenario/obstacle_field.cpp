#include "sim/scenario/obstacle_field.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <vector>

#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/config/outline_texts.h"
#include "sim/config/whole_file.h"
#include "sim/fields/file_fault.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;
using scenes::BoxConfig;
using scenes::MoverConfig;
using scenes::worlds::OpenConfig;

constexpr std::string_view kBoxPrefab = "rpg_box01";

[[noreturn]] void refuse_field(const Node& node, const std::string& fault) {
  throw InputError(fmt::format("{}: {}", node.position.text(), fault));
}

const Node& field_key(const Node& map, std::string_view key) {
  const Node* const value = map.kind == Node::Kind::map ? map.find(key) : nullptr;
  if (!value) refuse_field(map, fmt::format("missing key '{}'", key));
  return *value;
}

double field_number(const Node& node) {
  const ParsedNumber parsed = parse_number(node.text, false);
  if (node.kind != Node::Kind::scalar || parsed.kind != ParsedNumber::Kind::number)
    refuse_field(node, fmt::format("expected a number, got {}", node.description()));
  return parsed.member;
}

double field_number(const Node& map, std::string_view key) { return field_number(field_key(map, key)); }

bool field_bool(const Node& node) {
  if (node.text == "true" || node.text == "True") return true;
  if (node.text == "false" || node.text == "False") return false;
  refuse_field(node, fmt::format("expected true or false, got {}", node.description()));
}

Node read_field_yaml(const fs::path& file) {
  ErrorList errors("obstacle field");
  Node root = parse_yaml(read_file_whole(file), file.string(), errors);
  errors.throw_if_any();
  return root;
}

void add_aerialist(const fs::path& file, OpenConfig& scene) {
  const Node root = read_field_yaml(file);
  const Node& obstacles = field_key(field_key(root, "simulation"), "obstacles");
  if (obstacles.kind != Node::Kind::list) refuse_field(obstacles, "expected a list of obstacles");
  for (const Node& obstacle : obstacles.items) {
    const Node &size = field_key(obstacle, "size"), &position = field_key(obstacle, "position");
    scene.added.boxes.push_back({.name = fmt::format("obstacle {}", scene.added.boxes.size() + 1),
                                 .north_m = field_number(position, "x"),
                                 .east_m = field_number(position, "y"),
                                 .length_m = field_number(size, "l"),
                                 .width_m = field_number(size, "w"),
                                 .height_m = field_number(size, "h"),
                                 .heading_rad = field_number(position, "r") * std::numbers::pi / 180.0,
                                 .altitude_m = field_number(position, "z")});
  }
}

/// Splits a row at its commas and removes the space around the cells.
std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> cells;
  for (size_t at = 0; at <= row.size();) {
    const size_t end = std::min(row.find(',', at), row.size());
    const std::string_view cell = row.substr(at, end - at);
    const size_t first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.emplace_back(first == std::string_view::npos ? "" : cell.substr(first, last - first + 1));
    at = end + 1;
  }
  return cells;
}

void require_box_prefab(const std::string& name, const std::string& place) {
  if (name != kBoxPrefab)
    throw InputError(fmt::format("{}: prefab '{}' is unknown; valid: {}", place, name, kBoxPrefab));
}

BoxConfig flightmare_box(const std::vector<std::string>& cells, const std::string& place) {
  constexpr size_t kColumns = 11;
  if (cells.size() != kColumns)
    throw InputError(fmt::format("{}: expected {} values (prefab, position, quaternion, scale), got {}", place,
                                 kColumns, cells.size()));
  require_box_prefab(cells[0], place);
  std::array<double, kColumns> value{};
  for (size_t i = 1; i < kColumns; ++i) {
    const ParsedNumber parsed = parse_number(cells[i], false);
    if (parsed.kind != ParsedNumber::Kind::number)
      throw InputError(fmt::format("{}: expected a number, got '{}'", place, cells[i]));
    value[i] = parsed.member;
  }
  const Eigen::Vector4d q = Eigen::Vector4d(value[4], value[5], -value[6], -value[7]).normalized();
  return {.north_m = value[1],
          .east_m = -value[2],
          .length_m = value[8],
          .width_m = value[9],
          .height_m = value[10],
          .altitude_m = value[3] - 0.5 * value[10],
          .quaternion = {q[0], q[1], q[2], q[3]}};
}

void add_flightmare_boxes(const fs::path& file, OpenConfig& scene) {
  const std::string text = read_file_whole(file);
  int line = 0;
  for (size_t at = 0; at < text.size(); ++line) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view row = std::string_view(text).substr(at, end - at);
    at = end + 1;
    if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    BoxConfig box = flightmare_box(cells_of(row), fmt::format("{}:{}", file.string(), line + 1));
    box.name = fmt::format("box {}", scene.added.boxes.size() + 1);
    scene.added.boxes.push_back(std::move(box));
  }
}

MoverConfig flightmare_mover(const Entry& object, const fs::path& folder) {
  require_box_prefab(field_key(object.value, "prefab").text, object.position.text());
  const Node& scale = field_key(object.value, "scale");
  if (scale.items.size() != 3) refuse_field(scale, "expected 3 numbers");
  const std::string table = field_key(object.value, "csvtraj").text + ".csv";
  const bool restarts = field_bool(field_key(object.value, "loop"));
  using Repeat = scenes::TableMotion::Repeat;
  return {.name = object.key,
          .shape = MoverConfig::Shape::cuboid,
          .size_m = {field_number(scale.items[0]), field_number(scale.items[1]), field_number(scale.items[2])},
          .motion = scenes::TableMotion{.file = fs::absolute(folder / "csvtrajs" / table).lexically_normal().string(),
                                        .repeat = restarts ? Repeat::restart : Repeat::back_and_forth}};
}

void add_flightmare_movers(const fs::path& file, OpenConfig& scene) {
  const Node root = read_field_yaml(file);
  const double count = field_number(root, "N");
  const size_t before = scene.added.movers.size();
  for (const Entry& entry : root.entries) {
    if (entry.key != "N") scene.added.movers.push_back(flightmare_mover(entry, file.parent_path()));
  }
  if (const size_t found = scene.added.movers.size() - before; static_cast<double>(found) != count)
    refuse_field(field_key(root, "N"), fmt::format("N is {:g}, but the file has {} objects", count, found));
}

void require_sdf(const fs::path& file) {
  std::string fault = file_fault(file), suffix = file.extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix != ".sdf" && suffix != ".world") fault = "the suffix is unknown; valid: .sdf, .world";
  if (!fault.empty()) throw InputError(fmt::format("{}: {}", file.string(), fault));
}

}  // namespace

OpenConfig read_obstacle_field(FieldFormat format, std::span<const fs::path> files, double scale) {
  OpenConfig scene;
  for (const fs::path& file : files) {
    const std::string suffix = file.extension().string();
    if (format == FieldFormat::aerialist) {
      add_aerialist(file, scene);
    } else if (format == FieldFormat::sdf) {
      require_sdf(file);
      scene.added.imports.push_back(
          {.file = fs::absolute(file).lexically_normal().string(), .name = file.stem().string(), .scale = scale});
    } else if (suffix == ".csv") {
      add_flightmare_boxes(file, scene);
    } else {
      add_flightmare_movers(file, scene);
    }
  }
  return scene;
}

std::string scene_yaml(OpenConfig scene, const fs::path& folder) {
  const auto shorten = [&folder](std::string& file) {
    const fs::path relative = fs::path(file).lexically_relative(fs::absolute(folder / ".").lexically_normal());
    if (!relative.empty()) file = relative.string();
  };
  for (auto& import : scene.added.imports) shorten(import.file);
  for (MoverConfig& mover : scene.added.movers) shorten(std::get<scenes::TableMotion>(mover.motion).file);
  return fmt::format("type: {}\n{}", OpenConfig::kName, yaml_text(outline_fields(scene)));
}

}  // namespace hedgehop::sim
