#include "sim/falsify/shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/config/numbers.h"
#include "sim/config/whole_file.h"
#include "sim/falsify/box_constraints.h"
#include "sim/falsify/ddmin.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

/// Returns the removable items of a scenario as prefixes of key paths, such as "scene.boxes.0.".
std::vector<std::string> items_of(const Scenario& scenario) {
  std::vector<std::string> items;
  const auto add = [&items](const char* list, size_t count) {
    for (size_t k = 0; k < count; ++k) items.push_back(fmt::format("{}.{}.", list, k));
  };
  const scenes::SceneAdditions& added = std::visit(
      [](const auto& scene) -> const auto& { return scene.added; }, scenario.scene);
  add("scene.boxes", added.boxes.size());
  add("scene.movers", added.movers.size());
  add("failures", scenario.failures.size());
  return items;
}

/// Removes the entries of a list that are not in `kept`. @param item  number of the list's first item; advanced past
/// its last.
template <class T>
void keep(std::vector<T>& list, const Subset& kept, size_t& item) {
  std::vector<T> rest;
  for (T& entry : list) {
    if (std::ranges::binary_search(kept, item++)) rest.push_back(std::move(entry));
  }
  list = std::move(rest);
}

/// A variant of the failing flight.
struct Candidate {
  std::vector<std::string> values;  ///< of the search's parameters
  Subset kept;                      ///< numbers of items
  double duration_s = 0.0;
};

class Shrinker {
 public:
  Shrinker(const FalsifySearch& search, const FalsifyTrial& failure, const FlightRecord& record,
           const std::filesystem::path& folder, size_t max_trials, const FlyOne& fly)
      : search_(search),
        check_(failure.weakest.name),
        seed_(record.order.seed),
        folder_(folder),
        max_trials_(max_trials),
        fly_(fly) {
    best_ = {.values = failure.values, .kept = {}, .duration_s = search.scenario.duration_s};
    shrunk_.record = record;
    items_ = items_of(search.scenario);
    for (size_t k = 0; k < items_.size(); ++k) best_.kept.push_back(k);
    shrunk_.scenario = scenario_of(best_);
    shrunk_.items_before = items_.size();
  }

  Shrunk run() {
    remove_items();
    for (size_t i = 0; i < best_.values.size(); ++i) neutralize(i);
    shorten();
    round();
    shrunk_.items = best_.kept.size();
    return std::move(shrunk_);
  }

 private:
  void remove_items() {
    const Candidate all = best_;
    ddmin(items_.size(), [&](const Subset& kept) {
      Candidate fewer = all;
      fewer.kept = kept;
      return kept.size() == items_.size() || still_fails(fewer);
    });
  }

  /// Moves a parameter to its neutral value if the check still fails there, and otherwise towards it by bisection.
  void neutralize(size_t parameter) {
    const std::optional<double> neutral = search_.neutral[parameter];
    if (!neutral || is_removed(search_.sweep.parameters[parameter].path, best_)) return;
    double fails = parse_number(best_.values[parameter], false).member, holds = *neutral;
    if (fails == holds || try_value(parameter, holds)) return;
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (fails + holds);
      (try_value(parameter, middle) ? fails : holds) = middle;
    }
  }

  void shorten() {
    constexpr double kAfterS = 1.0;
    Candidate shorter = best_;
    shorter.duration_s = std::ceil(decided_s(shrunk_.record, check_) + kAfterS);
    if (shorter.duration_s < best_.duration_s) still_fails(shorter);
  }

  void round() {
    for (int decimals = 0; decimals <= 3; ++decimals) {
      Candidate rounded = best_;
      for (std::string& value : rounded.values) {
        const double power = std::pow(10.0, decimals);
        const double exact = parse_number(value, false).member;
        if (is_neutral_outside(static_cast<size_t>(&value - rounded.values.data()), exact)) continue;
        value = fmt::format("{}", std::round(exact * power) / power + 0.0);  // no -0
      }
      if (still_fails(rounded)) return;
    }
  }

  bool try_value(size_t parameter, double value) {
    Candidate candidate = best_;
    const bool whole = search_.sweep.parameters[parameter].whole;
    candidate.values[parameter] = whole ? fmt::format("{:.0f}", std::round(value)) : fmt::format("{}", value);
    return candidate.values[parameter] != best_.values[parameter] && still_fails(candidate);
  }

  bool is_removed(const std::string& path, const Candidate& candidate) const {
    for (size_t k = 0; k < items_.size(); ++k) {
      if (path.starts_with(items_[k])) return !std::ranges::binary_search(candidate.kept, k);
    }
    return false;
  }

  bool is_inside(size_t parameter, double value) const {
    const SweepParameter& p = search_.sweep.parameters[parameter];
    return value >= *p.from && value <= *p.to;
  }
  bool is_neutral_outside(size_t parameter, double value) const {
    const std::optional<double> neutral = search_.neutral[parameter];
    if (!neutral || is_inside(parameter, value)) return false;
    return value == (search_.sweep.parameters[parameter].whole ? std::round(*neutral) : *neutral);
  }

  /// Returns whether the search could have flown a candidate, except for neutral values outside their ranges. A value
  /// that the search flew may be outside by its rounding to a whole number.
  bool is_allowed(const Candidate& candidate) const {
    for (size_t i = 0; i < candidate.values.size(); ++i) {
      const std::string& text = candidate.values[i];
      if (text == best_.values[i] || is_removed(search_.sweep.parameters[i].path, candidate)) continue;
      const double value = parse_number(text, false).member;
      if (!is_inside(i, value) && !is_neutral_outside(i, value)) return false;
    }
    if (search_.config.constraints.empty()) return true;
    std::vector<scenes::BoxConfig> boxes = boxes_at(search_, candidate.values);
    size_t item = 0;
    keep(boxes, candidate.kept, item);
    return violation(search_, boxes) == 0.0;
  }

  Scenario scenario_of(const Candidate& candidate) const {
    std::vector<std::string> overrides = search_.sweep.set;
    for (size_t i = 0; i < candidate.values.size(); ++i) {
      overrides.push_back(search_.sweep.parameters[i].path + "=" + candidate.values[i]);
    }
    Scenario scenario = load_flight(search_.sweep.scenario, overrides, seed_).scenario;
    scenario.duration_s = candidate.duration_s;
    size_t item = 0;
    std::visit(
        [&](auto& scene) {
          keep(scene.added.boxes, candidate.kept, item);
          keep(scene.added.movers, candidate.kept, item);
        },
        scenario.scene);
    keep(scenario.failures, candidate.kept, item);
    return scenario;
  }

  /// Flies a candidate and returns whether the check still fails; if so, the candidate becomes the best one. An invalid
  /// scenario, or one that the search excludes, does not count as failing.
  bool still_fails(const Candidate& candidate) {
    if (shrunk_.stopped || shrunk_.trials >= max_trials_ || !is_allowed(candidate)) return false;
    try {
      const Scenario scenario = scenario_of(candidate);
      const std::string name = fmt::format("{:03}", shrunk_.trials);
      std::filesystem::create_directories(folder_);
      write_file_whole(folder_ / (name + ".yaml"), resolved_yaml(scenario, seed_));
      const Order order = file_order(folder_ / (name + ".yaml"), (folder_.filename() / name).string());
      ++shrunk_.trials;
      const std::optional<FlightRecord> record = fly_(order);
      shrunk_.stopped = !record;
      if (!record) return false;
      const auto now = weakest_check(*record, {check_});
      if (!now || now->name != check_ || now->robustness >= 0.0) return false;
      best_ = candidate;
      shrunk_.scenario = scenario;
      shrunk_.record = *record;
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  const FalsifySearch& search_;
  const std::string check_;
  const uint64_t seed_;
  const std::filesystem::path folder_;
  const size_t max_trials_;
  const FlyOne& fly_;
  std::vector<std::string> items_;
  Candidate best_;
  Shrunk shrunk_;
};

}  // namespace

Shrunk shrink(const FalsifySearch& search, const FalsifyTrial& failure, const FlightRecord& record,
              const std::filesystem::path& folder, size_t max_trials, const FlyOne& fly) {
  return Shrinker(search, failure, record, folder, max_trials, fly).run();
}

Order file_order(const std::filesystem::path& file, const std::string& id) {
  const LoadedScenario loaded = load_flight(file);
  Order order{.id = id, .group = file.stem().string(), .scenario = file, .seed = loaded.scenario.seed};
  order.scenario_yaml = resolved_yaml(loaded.scenario, order.seed);
  order.inputs = loaded.inputs;
  return order;
}

}  // namespace hedgehop::sim
