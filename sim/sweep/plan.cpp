#include "sim/sweep/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "sim/batch/seeds.h"
#include "sim/libm/random.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kMaxFaults = 50, kExamples = 3;

std::vector<std::string> overrides_of(const SweepConfig& sweep, const std::vector<std::string>& values) {
  std::vector<std::string> overrides = sweep.set;
  for (size_t i = 0; i < values.size(); ++i) overrides.push_back(sweep.parameters[i].path + "=" + values[i]);
  return overrides;
}

std::string point_words(const SweepConfig& sweep, const std::vector<std::string>& values) {
  std::vector<std::string> words;
  for (size_t i = 0; i < values.size(); ++i) words.push_back(sweep.parameters[i].path + "=" + values[i]);
  return fmt::format("{}", fmt::join(words, " "));
}

uint64_t hash_of(const Scenario& scenario) {
  Fnv1a hash;
  for (const char c : resolved_yaml(scenario, 0)) hash.add(static_cast<unsigned char>(c));
  return splitmix64(hash.value());
}

/// Returns the content of a scenario with overrides; none if it is invalid.
std::optional<uint64_t> content_with(const SweepConfig& sweep, const std::vector<std::string>& overrides) {
  try {
    return hash_of(load_scenario(sweep.scenario, overrides));
  } catch (const InputError&) {
    return {};
  }
}

/// Returns a few values of a parameter, from all over its range or list.
std::vector<std::string> probes(const SweepParameter& p) {
  constexpr size_t kProbes = 5;
  std::vector<std::string> values;
  const size_t count = p.values.empty() ? kProbes : std::min(kProbes, p.values.size());
  for (size_t i = 0; i < count; ++i) {
    const double share = count == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
    const auto last = static_cast<double>(p.values.size()) - 1.0;
    values.push_back(p.values.empty() ? parameter_value(p, share) : p.values[static_cast<size_t>(share * last)].text);
  }
  return values;
}

/// Returns whether a parameter changes the scenario of a point.
bool changes(const SweepConfig& sweep, std::vector<std::string> values, size_t parameter) {
  std::optional<uint64_t> first;
  for (const std::string& probe : probes(sweep.parameters[parameter])) {
    values[parameter] = probe;
    const std::optional<uint64_t> content = content_with(sweep, overrides_of(sweep, values));
    if (!content) return true;  // an invalid point is a fault of its own
    if (first && content != first) return true;
    first = content;
  }
  return false;
}

/// Returns whether a parameter changes the scenario if no other parameter is set.
bool changes_alone(const SweepConfig& sweep, size_t parameter) {
  SweepConfig alone = sweep;
  alone.parameters = {sweep.parameters[parameter]};
  return changes(alone, {""}, 0);
}

}  // namespace

uint64_t content_of(const SweepConfig& sweep, const std::vector<std::string>& values) {
  return hash_of(load_scenario(sweep.scenario, overrides_of(sweep, values)));
}

std::string point_number(uint64_t content) {
  const auto letter = static_cast<char>('a' + (content >> 60U));
  return fmt::format("{}{:011x}", letter, (content >> 16U) & 0xfffffffffffU);
}

std::vector<Order> point_orders(const SweepConfig& sweep, const std::vector<std::string>& values, std::string label) {
  Order order{.scenario = sweep.scenario, .overrides = overrides_of(sweep, values)};
  const LoadedScenario loaded = load_flight(order.scenario, order.overrides);
  if (label.empty()) label = point_number(hash_of(loaded.scenario));
  order.group = fmt::format("point {} {}", label, point_words(sweep, values));
  order.inputs = loaded.inputs;
  std::vector<Order> orders;
  for (const uint64_t seed : sweep.seeds ? parse_seeds(*sweep.seeds) : std::vector<uint64_t>{loaded.scenario.seed}) {
    order.seed = seed;
    order.id = fmt::format("flights/{}-seed{}", label, seed);
    order.scenario_yaml = resolved_yaml(loaded.scenario, seed);
    orders.push_back(order);
  }
  return orders;
}

SweepPlan::SweepPlan(const SweepConfig& sweep)
    : sweep_(sweep),
      design_(sweep),
      seeds_(sweep.seeds ? parse_seeds(*sweep.seeds) : std::vector<uint64_t>{0}),
      notices_(rounding_notices(sweep)) {
  require_effects();
  std::unordered_set<uint64_t> known;
  std::vector<std::string> faults, examples;
  size_t bad = 0, repeated = 0;
  for (size_t index = 0; index < design_.size(); ++index) {
    const std::vector<std::string> values = design_.values(index);
    try {
      const uint64_t content = content_of(sweep, values);
      if (block() > 0) content_.push_back(content);
      if (known.insert(content).second) {
        points_.push_back({content, static_cast<uint32_t>(index)});
      } else if (++repeated <= kExamples) {
        examples.push_back(point_words(sweep, values));
      }
    } catch (const InputError& error) {
      if (++bad > kMaxFaults) continue;
      for (const std::string& fault : error.errors()) {
        const std::string moved = at_parameter(sweep, fault);
        faults.push_back(moved != fault ? moved
                                        : fmt::format("{}: point {}: {}", sweep.design_position.text(),
                                                      point_words(sweep, values), fault));
      }
    }
  }
  if (bad > kMaxFaults) faults.push_back(fmt::format("... and {} more invalid points", bad - kMaxFaults));
  if (bad > 0) throw InputError(faults);
  note_repeated(repeated, examples);
}

void SweepPlan::note_repeated(size_t repeated, const std::vector<std::string>& examples) {
  if (repeated == 0) return;
  std::vector<std::string> shown = examples;
  if (repeated > examples.size()) shown.emplace_back("...");
  notices_.push_back(fmt::format("{}: {} of {} points repeat an earlier point and are flown once: {}",
                                 sweep_.file.string(), repeated, design_.size(), fmt::join(shown, ", ")));
}

void SweepPlan::require_effects() const {
  std::vector<std::string> faults;
  for (size_t i = 0; i < sweep_.parameters.size(); ++i) {
    const SweepParameter& p = sweep_.parameters[i];
    if (p.values.size() == 1 || sweep_.parameters.size() == 1) continue;
    const size_t last = design_.size() - 1;
    if (changes(sweep_, design_.values(0), i) || changes(sweep_, design_.values(last / 2), i) ||
        changes(sweep_, design_.values(last), i) || !changes_alone(sweep_, i)) {
      continue;  // without a change alone, its values are equal, and its points are repetitions
    }
    const auto over = std::ranges::find_if(
        sweep_.parameters, [&](const SweepParameter& other) { return p.path.starts_with(other.path + "."); });
    const std::string cause =
        over == sweep_.parameters.end() ? "other parameters override it" : fmt::format("'{}' overrides it", over->path);
    faults.push_back(fmt::format("{}: '{}' has no effect: {}; remove one of them, or list '{}' last", p.position.text(),
                                 p.path, cause, p.path));
  }
  if (!faults.empty()) throw InputError(faults);
}

SweepOrders SweepPlan::orders(size_t first, size_t count, Shard shard) const {
  SweepOrders all;
  for (size_t i = first; i < std::min(points_.size(), first + count); ++i) {
    const size_t from = i * seeds_.size();  // number of its first flight
    const auto flies = [&](size_t flight) { return flight % shard.of == shard.index - 1; };
    bool any = false;
    for (size_t k = 0; k < seeds_.size(); ++k) any = any || flies(from + k);
    if (!any) continue;
    const std::vector<std::string> values = design_.values(points_[i].index);
    std::vector<Order> orders = point_orders(sweep_, values);
    const std::string number = point_number(points_[i].content);
    for (size_t k = 0; k < orders.size(); ++k) {
      if (flies(from + k)) all.add(std::move(orders[k]), values, number);
    }
  }
  return all;
}

std::vector<std::string> SweepPlan::numbers_of_design() const {
  std::vector<std::string> numbers;
  for (const uint64_t content : content_) numbers.push_back(point_number(content));
  return numbers;
}

}  // namespace hedgehop::sim
