#include "sim/scenario/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <variant>

#include "sim/config/names.h"
#include "sim/scenario/formula.h"
#include "sim/scenario/judge_metrics.h"
#include "sim/scenario/reference_path.h"

namespace hedgehop::sim {
namespace {

/// Returns the name of a check as in results.
std::string check_name(const CheckConfig& config) {
  return std::visit(
      []<class Check>(const Check& check) -> std::string {
        if constexpr (std::same_as<Check, FormulaCheck> || std::same_as<Check, MetricCheck>) {
          return check.name;
        } else {
          return std::string(Check::kName);
        }
      },
      config);
}

/// Figures of the judge that are never negative.
constexpr auto kNotNegative = std::to_array<std::string_view>(
    {"success", "collision", "center_collision", "hull_collision", "shortest_path", "off_course_at_end_m",
     "time_to_collision_at_reaction_s", "jerk_rms", "actuator_effort"});
constexpr double kKnownClearanceM = 50.0;  // distances of obstacles are known up to here (sim/flight)

class CheckValidator {
 public:
  explicit CheckValidator(const Scenario& scenario) : scenario_(scenario) {}

  std::vector<FieldError> errors() {
    for (size_t i = 0; i < scenario_.checks.size(); ++i) {
      const std::string path = fmt::format("checks.{}", i);
      std::visit([&](const auto& check) { this->check(path, check); }, scenario_.checks[i]);
    }
    return std::move(errors_);
  }

 private:
  void check(const std::string& path, const ReachedGoalCheck& check) {
    if (!scenario_.goal) add(path, "the scenario has no goal to reach");
    if (check.within_m && scenario_.goal && *check.within_m < scenario_.goal->radius_m) {
      add(path + ".within",
          fmt::format("is less than the goal's radius ({} m), at which the flight ends", scenario_.goal->radius_m));
    }
    if (check.before_s && *check.before_s > scenario_.duration_s) {
      add(path + ".before", fmt::format("is after the end of the flight ({} s)", scenario_.duration_s));
    }
  }
  void check(const std::string& path, const NoCollisionCheck&) {
    if (scenario_.may_collide) add(path, "contradicts 'may_collide: true'");
  }
  void check(const std::string& path, const MinClearanceCheck& check) {
    if (check.to != MinClearanceCheck::To::ground && check.at_least_m > kKnownClearanceM) {
      add(path + ".at_least", fmt::format("{:g} m is beyond the distance up to which obstacles are known ({:g} m)",
                                          check.at_least_m, kKnownClearanceM));
    }
  }
  void check(const std::string& path, const AltitudeBandCheck& check) {
    ordered(path + ".max", "min", check.min_m, check.max_m);
  }
  void check(const std::string& path, const InsideBoxCheck& check) {
    ordered(path + ".north_max", "north_min", check.north_min_m, check.north_max_m);
    ordered(path + ".east_max", "east_min", check.east_min_m, check.east_max_m);
  }
  void check(const std::string& path, const MetricCheck& check) {
    const std::vector<std::string_view> metrics = judge_metrics();
    if (!check.name.starts_with("module.") && std::ranges::find(metrics, check.name) == metrics.end()) {
      add(path + ".name", fmt::format("is not a metric{}; the names of a module's own metrics begin with 'module.'",
                                      suggestion(check.name, metrics)));
    }
    if (std::string fault = name_fault(check.name); !fault.empty()) add(path + ".name", std::move(fault));
    if (!check.at_least && !check.at_most) add(path, "needs 'at_least' or 'at_most'");
    if (check.at_least && check.at_most && *check.at_least > *check.at_most) {
      add(path + ".at_most", "must not be less than 'at_least'");
    }
    if (check.at_most && *check.at_most < 0.0 && std::ranges::find(kNotNegative, check.name) != kNotNegative.end())
      add(path + ".at_most", fmt::format("must be >= 0, because {} is never negative", check.name));
  }
  void check(const std::string& path, const PathToleranceCheck& check) {
    unless_valid(path + ".reference", [&] { read_reference_path(check.reference); });
  }
  void check(const std::string& path, const FormulaCheck& check) {
    if (std::string fault = name_fault(check.name); !fault.empty()) add(path + ".name", std::move(fault));
    if (check.name == NoCollisionCheck::kName || std::ranges::count(scenario_.checks, check.name, check_name) > 1) {
      add(path + ".name", fmt::format("'{}' is another check's name", check.name));
    }
    unless_valid(path + ".formula", [&] {
      const Formula formula = parse_formula(check.formula);
      if (!scenario_.goal && uses_signal(formula, "goal_distance"))
        add(path + ".formula", "uses 'goal_distance', but the scenario has no goal");
      const double ahead_s = horizon_s(formula);
      if (ahead_s > scenario_.duration_s) {
        add(path + ".formula",
            fmt::format("looks {:g} s ahead, which is longer than the flight ({:g} s)", ahead_s, scenario_.duration_s));
      }
    });
  }
  template <class Check>
  void check(const std::string&, const Check&) {}

  void ordered(const std::string& path, std::string_view lower, double min, double max) {
    if (!(min < max)) add(path, fmt::format("must be greater than '{}' ({} m), got {}", lower, min, max));
  }

  template <class Use>
  void unless_valid(const std::string& path, Use&& use) {
    try {
      use();
    } catch (const std::invalid_argument& error) {
      add(path, error.what());
    }
  }

  void add(std::string path, std::string message) { errors_.push_back({std::move(path), std::move(message)}); }

  const Scenario& scenario_;
  std::vector<FieldError> errors_;
};

}  // namespace

std::vector<std::string> check_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const CheckConfig& check : scenario.checks) names.push_back(check_name(check));
  const bool implied = std::ranges::find(names, NoCollisionCheck::kName) == names.end() && !scenario.may_collide;
  if (implied) names.emplace_back(NoCollisionCheck::kName);
  return names;
}

std::vector<FieldError> check_errors(const Scenario& scenario) { return CheckValidator(scenario).errors(); }

}  // namespace hedgehop::sim
