#include "sim/falsify/falsify_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/reader.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/inputs.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kMaxForDirect = 5;  // unknowns; the flights that DIRECT needs grow steeply with the dimension

/// Returns the unknowns of a box: key and range.
std::vector<std::pair<std::string_view, Eigen::Vector2d>> ranges(const FalsifyBoxes& c) {
  return {{"north", c.north_m}, {"east", c.east_m},     {"length", c.length_m},
          {"width", c.width_m}, {"height", c.height_m}, {"heading", c.heading_deg}};
}

/// Adds one override that places the boxes at the middles of their ranges, and one parameter per range.
void add_boxes(const FalsifyBoxes& boxes, FalsifySearch& search) {
  std::string list;
  for (size_t k = 0; k < static_cast<size_t>(boxes.count); ++k) {
    list += fmt::format("{}{{name: box {}", k == 0 ? "" : ", ", k + 1);
    for (const auto& [key, range] : ranges(boxes)) {
      list += fmt::format(", {}: {}", key, 0.5 * range.sum());
      if (range[0] == range[1]) continue;
      SweepParameter parameter{.path = box_path(k, key), .values = {}};
      parameter.from = range[0];
      parameter.to = range[1];
      search.sweep.parameters.push_back(parameter);
      const bool is_size = key == "length" || key == "width" || key == "height";
      search.neutral.push_back(is_size ? std::optional(range[0]) : std::nullopt);  // a small box is a small disturbance
    }
    list += "}";
  }
  search.sweep.set.push_back("scene.boxes=[" + list + "]");
}

void add_parameters(const std::vector<FalsifyParameter>& parameters, FalsifySearch& search) {
  for (const FalsifyParameter& p : parameters) {
    SweepParameter parameter{.path = p.path, .values = {}};
    parameter.from = p.from;
    parameter.to = p.to;
    parameter.scale = p.scale;
    parameter.whole = p.whole;
    search.sweep.parameters.push_back(parameter);
    search.neutral.push_back(p.neutral);
  }
}

class Inspector {
 public:
  Inspector(const FalsifyConfig& config, const Node& root, ErrorList& faults)
      : config_(config), root_(root), faults_(faults) {}

  void inspect() {
    if (config_.parameters.empty() && !config_.boxes) faults_.add(root_.position, "needs 'parameters' or 'boxes'");
    std::set<std::string> paths;
    for (size_t i = 0; i < config_.parameters.size(); ++i) {
      const FalsifyParameter& p = config_.parameters[i];
      const std::string at = fmt::format("parameters.{}", i);
      if (p.path == "seed") add(at, "'seed': varied by 'seeds', not as a parameter");
      if (!(p.from < p.to)) add(at + ".to", fmt::format("'{}': 'from' must be less than 'to'", p.path));
      if (p.scale == SweepParameter::Scale::log && !(p.from > 0.0)) add(at + ".from", "a log range needs 'from' > 0");
      if (!paths.insert(p.path).second) add(at, fmt::format("'{}' occurs twice", p.path));
    }
    const size_t seeds = config_.seeds ? parse_seeds(*config_.seeds).size() : 1;
    if (static_cast<size_t>(config_.design.budget) < seeds) {
      add("design.budget",
          fmt::format("{} flights are fewer than the {} seeds of one point", config_.design.budget, seeds));
    }
    if (config_.boxes) boxes(*config_.boxes);
    if (config_.score == FalsifyScore::sbft) competition();
    if (!config_.constraints.empty() && !config_.boxes)
      add("constraints", "'constraints' require 'boxes', which are missing");
  }

 private:
  /// The competition's rules fix seeds and checks, and its areas of boxes are sums.
  void competition() {
    const auto& constraints = config_.constraints;
    if (!config_.boxes) add("score", "'score: sbft' requires 'boxes', which are missing");
    if (std::ranges::find(constraints, FalsifyConstraint::boxes_apart) == constraints.end())
      add("score", "'score: sbft' requires the constraint 'boxes_apart'");
    if (config_.seeds)
      add("seeds", "'seeds': 'score: sbft' flies the scenario's seed, and failing tests with the next five");
    if (!config_.robustness.empty()) add("robustness", "'robustness' has no effect with 'score: sbft'");
  }
  void boxes(const FalsifyBoxes& c) {
    for (const auto& [key, range] : ranges(c)) {
      if (range[0] > range[1]) {
        add(fmt::format("boxes.{}", key), fmt::format("'boxes.{}': the lower end must come first", key));
      }
    }
  }
  void add(const std::string& path, const std::string& message) { faults_.add(position_of(root_, path), message); }

  const FalsifyConfig& config_;
  const Node& root_;
  ErrorList& faults_;
};

void require_known_checks(const FalsifySearch& search, const Node& root, ErrorList& faults) {
  const std::vector<std::string> names = check_names(search.scenario);
  const std::vector<std::string_view> known(names.begin(), names.end());
  for (const std::string& name : search.config.robustness) {
    if (std::ranges::find(names, name) != names.end()) continue;
    faults.add(position_of(root, "robustness"),
               fmt::format("the scenario has no check '{}'{}", name, suggestion(name, known)));
  }
  if (names.empty()) faults.add(position_of(root, "scenario"), "the scenario has no checks that could fail");
}

}  // namespace

std::string box_path(size_t box, std::string_view key) { return fmt::format("scene.boxes.{}.{}", box, key); }

FalsifySearch read_falsify(const std::filesystem::path& file, std::span<const std::string> overrides) {
  ErrorList faults("search");
  std::set<std::filesystem::path> read;
  Node root = load_tree(file, faults, read);
  if (root.kind == Node::Kind::map) apply_overrides(root, overrides, file, faults, read);
  FalsifySearch search;
  if (root.kind == Node::Kind::map) read_struct(root, "", "", search.config, faults);
  faults.throw_if_any();
  FalsifyConfig& config = search.config;
  Inspector(config, root, faults).inspect();
  faults.throw_if_any();

  config.scenario = (file.parent_path() / config.scenario).lexically_normal().string();
  search.sweep = {.scenario = config.scenario, .seeds = config.seeds, .set = config.set};
  if (config.boxes) {
    const Scenario bare = load_scenario(config.scenario, config.set);
    const bool has_boxes = std::visit([](const auto& scene) { return !scene.added.boxes.empty(); }, bare.scene);
    if (has_boxes) faults.add(position_of(root, "boxes"), "the scenario has boxes of its own");
    faults.throw_if_any();
    add_boxes(*config.boxes, search);
  }
  add_parameters(config.parameters, search);
  const size_t boxes = search.sweep.parameters.size() - config.parameters.size();
  for (size_t i = 0; i < config.parameters.size(); ++i) {
    search.sweep.parameters[boxes + i].position = position_of(root, fmt::format("parameters.{}.path", i));
  }
  for (size_t i = 0; i < config.set.size(); ++i) {
    search.sweep.set_positions.push_back(position_of(root, fmt::format("set.{}", i)));
  }
  if (config.design.method == FalsifyDesign::Method::direct && search.sweep.parameters.size() > kMaxForDirect) {
    faults.add(position_of(root, "design"), fmt::format("'direct' supports up to {} unknowns; there are {}",
                                                        kMaxForDirect, search.sweep.parameters.size()));
  }
  if (const std::vector<std::string> refused = refused_parameters(search.sweep); !refused.empty()) {
    throw InputError(refused);
  }
  const LoadedScenario loaded = load_flight(config.scenario, search.sweep.set);
  search.scenario = loaded.scenario;
  require_known_checks(search, root, faults);
  faults.throw_if_any();
  for (const std::filesystem::path& one : read) search.identity += sha256(one) + " ";
  for (const auto& [name, hash] : loaded.inputs) search.identity += hash + " ";
  for (const std::string& text : overrides) search.identity += text + " ";
  return search;
}

}  // namespace hedgehop::sim
