#include "sim/sweep/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "sim/batch/flight_table.h"
#include "sim/batch/input_files.h"
#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/outline_texts.h"
#include "sim/config/reader.h"
#include "sim/scenario/file_kind.h"
#include "sim/scenario/flight_parts.h"
#include "sim/sweep/design.h"
#include "sim/sweep/sampling.h"

namespace hedgehop::sim {
namespace {

/// Returns the fault of a parameter; "" if it is valid.
std::string parameter_fault(const SweepParameter& p, const SweepDesign& design) {
  const bool is_grid = std::holds_alternative<GridDesign>(design);
  const auto* const sobol = std::get_if<SobolDesign>(&design);
  if (p.path == "seed") return "varied by 'seeds', not as a parameter";
  if (p.values.empty() && !(p.from && p.to)) return "needs 'values', or 'from' and 'to'";
  if (!p.values.empty() && (p.from || p.to || p.count > 0)) return "has both values and a range";
  if (!p.values.empty() && (p.whole || p.scale == SweepParameter::Scale::log))
    return "'scale' and 'whole' are for a range";
  if (p.count > 0 && !is_grid) return "'count' is for a grid";
  if (p.values.empty() && !(*p.from < *p.to)) return "'from' must be less than 'to'";
  if (p.values.empty() && p.scale == SweepParameter::Scale::log && !(*p.from > 0.0))
    return "a log range needs 'from' > 0";
  if (p.values.empty() && is_grid && p.count < 2) return "a grid needs 'count' >= 2 of a range";
  if (p.values.empty() && std::holds_alternative<ListDesign>(design)) return "a list needs 'values'";
  if (!p.values.empty() && std::holds_alternative<OptimizeDesign>(design)) return "an optimizer needs a range";
  if (!p.values.empty() && sobol && sobol->indices) return "Sobol indices need a range";
  return "";
}

/// Adds the faults of the design as a whole.
void inspect_design(const SweepConfig& sweep, const Node& root, ErrorList& faults) {
  if (const size_t points = count_points(sweep); points > kMaxSweepPoints) {
    double product = 1.0;
    for (const SweepParameter& p : sweep.parameters) {
      product *= static_cast<double>(p.values.empty() ? p.count : static_cast<int64_t>(p.values.size()));
    }
    const bool is_grid = std::holds_alternative<GridDesign>(sweep.design);
    faults.add(position_of(root, is_grid ? "parameters" : "design.points"),
               fmt::format("{} points; a sweep has at most {}",
                           is_grid ? fmt::format("the grid has {:.6g}", product) : "the design has too many",
                           kMaxSweepPoints));
  }
  const auto* const sobol = std::get_if<SobolDesign>(&sweep.design);
  const size_t coordinates = sweep.parameters.size() * (sobol && sobol->indices ? 2 : 1);
  if (sobol && coordinates > kSobolDimensions) {
    faults.add(position_of(root, "design"),
               fmt::format("Sobol's sequence supports {} parameters{}; there are {}",
                           kSobolDimensions / (sobol->indices ? 2 : 1), sobol->indices ? " with indices" : "",
                           sweep.parameters.size()));
  }
}

void inspect_parameters(const SweepConfig& sweep, const Node& root, ErrorList& faults) {
  std::set<std::string> paths;
  for (size_t i = 0; i < sweep.parameters.size(); ++i) {
    const std::string at = fmt::format("parameters.{}", i);
    const SweepParameter& parameter = sweep.parameters[i];
    const std::string fault = parameter_fault(parameter, sweep.design);
    if (!fault.empty()) faults.add(position_of(root, at), fmt::format("'{}': {}", parameter.path, fault));
    if (!paths.insert(parameter.path).second)
      faults.add(position_of(root, at), fmt::format("'{}' occurs twice", parameter.path));
    if (std::holds_alternative<ListDesign>(sweep.design) &&
        parameter.values.size() != sweep.parameters[0].values.size()) {
      faults.add(position_of(root, at),
                 fmt::format("'{}': a list requires the same number of values for each parameter", parameter.path));
    }
  }
  if (sweep.parameters.empty()) faults.add(position_of(root, "parameters"), "requires at least one parameter");
}

void inspect_seeds(const SweepConfig& sweep, const Node& root, ErrorList& faults) {
  for (const auto& [key, seeds] : {std::pair("seeds", sweep.seeds), std::pair("tuned_on", sweep.tuned_on)}) {
    try {
      if (seeds) parse_seeds(*seeds);
    } catch (const InputError& error) {
      faults.add(position_of(root, key), error.errors().front());
    }
  }
  if (!faults.empty() || !sweep.seeds || !sweep.tuned_on || within(*sweep.seeds, *sweep.tuned_on)) return;
  faults.add(position_of(root, "seeds"), fmt::format("seeds '{}' are not all of tuned_on '{}': a sweep chooses "
                                                     "parameters, so its seeds must not judge",
                                                     *sweep.seeds, *sweep.tuned_on));
}

/// Reads the scenario without the parameters. Its faults name the sweep's line, too.
Scenario base_scenario(const SweepConfig& sweep, const Node& root) {
  std::error_code ignored;
  if (!std::filesystem::exists(sweep.scenario, ignored)) {
    ErrorList faults("sweep");
    faults.add(
        position_of(root, "scenario"),
        fmt::format("there is no such file: '{}'{}", sweep.scenario,
                    std::filesystem::path(sweep.scenario).is_relative() ? " (relative to the sweep's folder)" : ""));
    faults.throw_if_any();
  }
  try {
    return load_scenario(sweep.scenario, sweep.set);
  } catch (const InputError& error) {
    const std::vector<std::string> refused = refused_parameters(sweep);
    if (refused.empty()) {  // a parameter completes the scenario
      std::vector<std::string> overrides = sweep.set;
      overrides.push_back(sweep.parameters[0].path + "=" + parameter_value(sweep.parameters[0], 0.0));
      return load_scenario(sweep.scenario, overrides);
    }
    std::vector<std::string> lines;
    for (const std::string& fault : error.errors()) lines.push_back(at_parameter(sweep, fault));
    const auto of_scenario = [&](const std::string& text) {
      const auto is_same = [&](const std::string& fault) { return text.ends_with(fault); };
      return std::ranges::any_of(error.errors(), is_same) || std::ranges::any_of(lines, is_same);
    };
    std::ranges::remove_copy_if(refused, std::back_inserter(lines), of_scenario);
    throw InputError(lines);
  }
}

/// Refuses a file of another kind by one error that names the kind.
void require_sweep(const Node& root, ErrorList& faults) {
  if (root.incomplete) faults.throw_if_any();  // the missing file may have the keys of its kind
  const std::string kind = file_kind(root);
  if (kind.empty()) return;
  faults.add(root.position, "is not a sweep but " + kind);
  faults.throw_if_any();
}

/// Throws the faults of the file, if any, with those of its overrides.
void throw_with_scenario(const SweepConfig& sweep, const ErrorList& faults) {
  try {
    faults.throw_if_any();
  } catch (const InputError& error) {
    std::vector<std::string> lines = error.errors();
    try {
      load_scenario(sweep.scenario, sweep.set);
    } catch (const InputError& more) {
      for (const std::string& fault : more.errors()) {
        const std::string moved = at_parameter(sweep, fault);
        if (moved != fault) lines.push_back(moved);
      }
    }
    throw InputError(lines);
  }
}

}  // namespace

void SweepValue::read(const Node& node, const std::string&, const fields::Field&, ErrorList&) {
  text = node.kind == Node::Kind::scalar ? node.text : flow_text(node);
  position = node.position;
}

ConfigOutline SweepValue::outlined(const fields::Field& field) const {
  ConfigOutline outline;
  outline.kind = ConfigOutline::Kind::any;
  outline.field = field;
  outline.value = text;
  return outline;
}

SweepConfig read_sweep(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ErrorList faults("sweep");
  Node root = load_tree(file, faults);
  SweepConfig sweep;
  if (!root.find("parameters")) require_sweep(root, faults);
  if (Node* design = root.find("design"); design && design->kind == Node::Kind::scalar) {
    faults.add(design->position,
               fmt::format("'design' expects a map of keys, such as {{type: {0}}}, got '{0}'", design->text));
    Node map;
    map.kind = Node::Kind::map;
    map.position = design->position;
    map.entries.push_back({"type", design->position, *design});
    *design = std::move(map);
  }
  const size_t faults_before = faults.count();
  if (root.kind == Node::Kind::map) read_struct(root, "", "", sweep, faults);
  if (faults.count() == faults_before) {
    inspect_parameters(sweep, root, faults);
    inspect_seeds(sweep, root, faults);
    if (faults.empty()) inspect_design(sweep, root, faults);
  }
  sweep.file = file;
  sweep.scenario = (file.parent_path() / sweep.scenario).lexically_normal().string();
  sweep.design_position = position_of(root, "design");
  for (size_t i = 0; i < sweep.parameters.size(); ++i) {
    sweep.parameters[i].position = position_of(root, fmt::format("parameters.{}.path", i));
  }
  for (size_t i = 0; i < sweep.set.size(); ++i) {
    sweep.set_positions.push_back(position_of(root, fmt::format("set.{}", i)));
  }
  sweep.set = with_module_paths(sweep.set, file.parent_path());
  throw_with_scenario(sweep, faults);
  for (const std::string& text : overrides) {
    const std::string key = text.substr(0, text.find('='));
    if (std::ranges::find(sweep.parameters, key, &SweepParameter::path) != sweep.parameters.end())
      throw InputError(fmt::format("--set {}: is a parameter of {}", key, file.string()));
    sweep.set.push_back(text);
    sweep.set_positions.emplace_back();
  }
  const Scenario scenario = base_scenario(sweep, root);
  if (const std::vector<std::string> refused = refused_parameters(sweep); !refused.empty()) throw InputError(refused);
  if (const auto* optimize = std::get_if<OptimizeDesign>(&sweep.design)) {
    const std::string fault = column_fault(optimize->minimize, scenario);
    if (!fault.empty()) faults.add(position_of(root, "design.minimize"), fault);
  }
  faults.throw_if_any();
  return sweep;
}

std::string at_parameter(const SweepConfig& sweep, const std::string& fault) {
  const auto replaced = [&](const std::string& key, const SourcePosition& position) {
    const std::string prefix = "--set " + key + ": ";
    return position.file.empty() || !fault.starts_with(prefix)
               ? std::string()
               : fmt::format("{}: {}", position.text(), fault.substr(prefix.size()));
  };
  for (const SweepParameter& parameter : sweep.parameters) {
    if (std::string text = replaced(parameter.path, parameter.position); !text.empty()) return text;
  }
  for (size_t i = 0; i < sweep.set_positions.size(); ++i) {
    const std::string key = sweep.set[i].substr(0, sweep.set[i].find('='));
    if (std::string text = replaced(key, sweep.set_positions[i]); !text.empty()) return text;
  }
  return fault;
}

std::vector<std::string> refused_parameters(const SweepConfig& sweep) {
  std::vector<std::string> faults;
  for (const SweepParameter& p : sweep.parameters) {
    std::vector<SweepValue> values = p.values;
    if (values.empty()) values = {{parameter_value(p, 0.0), p.position}, {parameter_value(p, 1.0), p.position}};
    for (const SweepValue& value : values) {
      std::vector<std::string> overrides = sweep.set;
      overrides.push_back(p.path + "=" + value.text);
      try {
        load_scenario(sweep.scenario, overrides);
      } catch (const InputError& error) {
        for (std::string fault : error.errors()) {
          const std::string moved = at_parameter(sweep, fault);
          if (moved != fault) {
            fault = moved;
          } else if (!p.position.file.empty()) {
            fault = fmt::format("{}: with {}: {}", value.position.text(), overrides.back(), fault);
          }
          if (std::ranges::find(faults, fault) == faults.end()) faults.push_back(fault);
        }
      }
    }
  }
  return faults;
}

std::string parameter_value(const SweepParameter& p, double coordinate) {
  if (!p.values.empty()) {
    const auto index = static_cast<size_t>(coordinate * static_cast<double>(p.values.size()));
    return p.values[std::min(index, p.values.size() - 1)].text;
  }
  double value = p.scale == SweepParameter::Scale::log ? *p.from * std::pow(*p.to / *p.from, coordinate)
                                                       : *p.from + coordinate * (*p.to - *p.from);
  if (coordinate == 1.0) value = *p.to;  // without pow's rounding
  if (p.whole) return fmt::format("{:.0f}", std::round(value));
  return fmt::format("{}", value);
}

}  // namespace hedgehop::sim
