#include "sim/sweep/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/batch/input_files.h"
#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/numbers.h"
#include "sim/config/reader.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

/// Returns the fault of a parameter; "" if it is valid.
std::string parameter_fault(const SweepParameter& p, const SweepDesign& design) {
  const bool is_grid = std::holds_alternative<GridDesign>(design);
  if (p.path == "seed") return "varied by 'seeds', not as a parameter";
  if (p.values.empty() && !(p.from && p.to)) return "needs 'values', or 'from' and 'to'";
  if (!p.values.empty() && (p.from || p.to || p.count > 0)) return "has both values and a range";
  if (p.values.empty() && !(*p.from < *p.to)) return "'from' must be less than 'to'";
  if (p.values.empty() && p.scale == SweepParameter::Scale::log && !(*p.from > 0.0))
    return "a log range needs 'from' > 0";
  if (p.values.empty() && is_grid && p.count < 2) return "a grid needs 'count' >= 2 of a range";
  if (p.values.empty() && std::holds_alternative<ListDesign>(design)) return "a list needs 'values'";
  if (!p.values.empty() && std::holds_alternative<OptimizeDesign>(design)) return "an optimizer needs a range";
  return "";
}

size_t grid_count(const SweepParameter& p) { return p.values.empty() ? static_cast<size_t>(p.count) : p.values.size(); }

std::string grid_value(const SweepParameter& p, size_t index) {
  if (!p.values.empty()) return p.values[index];
  return parameter_value(p, static_cast<double>(index) / static_cast<double>(p.count - 1));
}

std::vector<std::vector<std::string>> grid(const std::vector<SweepParameter>& parameters) {
  std::vector<std::vector<std::string>> points{{}};
  for (const SweepParameter& p : parameters) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& point : points) {
      for (size_t i = 0; i < grid_count(p); ++i) {
        longer.push_back(point);
        longer.back().push_back(grid_value(p, i));
      }
    }
    points = std::move(longer);
  }
  return points;
}

}  // namespace

SweepConfig read_sweep(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ErrorList faults("sweep");
  const Node root = load_tree(file, faults);
  SweepConfig sweep;
  if (root.kind == Node::Kind::map) read_struct(root, "", "", sweep, faults);
  faults.throw_if_any();

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
  if (sweep.seeds) parse_seeds(*sweep.seeds);
  if (sweep.seeds && sweep.tuned_on && !within(*sweep.seeds, *sweep.tuned_on)) {
    faults.add(position_of(root, "seeds"), fmt::format("seeds '{}' are not all of tuned_on '{}': a sweep chooses "
                                                       "parameters, so its seeds must not judge",
                                                       *sweep.seeds, *sweep.tuned_on));
  }
  faults.throw_if_any();
  for (const std::string& text : overrides) {
    if (const std::string key = text.substr(0, text.find('=')); paths.contains(key))
      throw InputError(fmt::format("--set {}: is a parameter of {}", key, file.string()));
  }
  sweep.set = with_module_paths(sweep.set, file.parent_path());
  sweep.set.insert(sweep.set.end(), overrides.begin(), overrides.end());
  sweep.scenario = (file.parent_path() / sweep.scenario).lexically_normal().string();
  if (const std::vector<std::string> refused = refused_parameters(sweep); !refused.empty()) throw InputError(refused);
  return sweep;
}

std::vector<std::string> refused_parameters(const SweepConfig& sweep) {
  std::vector<std::string> faults;
  for (const SweepParameter& p : sweep.parameters) {
    std::vector<std::string> values = p.values;
    if (values.empty()) values = {parameter_value(p, 0.0), parameter_value(p, 1.0)};
    for (const std::string& value : values) {
      std::vector<std::string> overrides = sweep.set;
      overrides.push_back(p.path + "=" + value);
      try {
        load_scenario(sweep.scenario, overrides);
      } catch (const InputError& error) {
        for (const std::string& fault : error.errors()) {
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
    return p.values[std::min(index, p.values.size() - 1)];
  }
  double value = p.scale == SweepParameter::Scale::log ? *p.from * std::pow(*p.to / *p.from, coordinate)
                                                       : *p.from + coordinate * (*p.to - *p.from);
  if (coordinate == 1.0) value = *p.to;  // without pow's rounding
  if (p.whole) return fmt::format("{:.0f}", std::round(value));
  return fmt::format("{}", value);
}

std::vector<std::vector<std::string>> design_points(const SweepConfig& sweep) {
  const std::vector<SweepParameter>& parameters = sweep.parameters;
  std::vector<std::vector<std::string>> points;
  if (std::holds_alternative<GridDesign>(sweep.design)) return grid(parameters);
  if (std::holds_alternative<ListDesign>(sweep.design)) {
    for (size_t i = 0; i < parameters[0].values.size(); ++i) {
      points.emplace_back();
      for (const SweepParameter& p : parameters) points.back().push_back(p.values[i]);
    }
    return points;
  }
  UnitPoints unit;
  if (const auto* random = std::get_if<RandomDesign>(&sweep.design)) {
    unit = random_points(static_cast<size_t>(random->points), parameters.size(), random->seed);
  } else if (const auto* latin = std::get_if<LatinHypercubeDesign>(&sweep.design)) {
    unit = latin_hypercube(static_cast<size_t>(latin->points), parameters.size(), latin->seed);
  } else if (const auto* sobol = std::get_if<SobolDesign>(&sweep.design)) {
    unit = build_part("design", [&] { return sobol_points(static_cast<size_t>(sobol->points), parameters.size()); });
  }
  for (const std::vector<double>& coordinates : unit) {
    points.emplace_back();
    for (size_t i = 0; i < parameters.size(); ++i) {
      points.back().push_back(parameter_value(parameters[i], coordinates[i]));
    }
  }
  return points;
}

std::vector<Order> point_orders(const SweepConfig& sweep, size_t point, const std::vector<std::string>& values) {
  Order order{.scenario = sweep.scenario, .overrides = sweep.set};
  order.group = fmt::format("point {}", point);
  for (size_t i = 0; i < values.size(); ++i) {
    order.overrides.push_back(sweep.parameters[i].path + "=" + values[i]);
    order.group += " " + order.overrides.back();
  }
  const LoadedScenario loaded = load_flight(order.scenario, order.overrides);
  const Scenario& scenario = loaded.scenario;
  order.inputs = loaded.inputs;
  std::vector<Order> orders;
  for (const uint64_t seed : sweep.seeds ? parse_seeds(*sweep.seeds) : std::vector<uint64_t>{scenario.seed}) {
    order.seed = seed;
    order.id = fmt::format("flights/{:06}-seed{}", point, seed);
    order.scenario_yaml = resolved_yaml(scenario, seed);
    orders.push_back(order);
  }
  return orders;
}

}  // namespace hedgehop::sim
