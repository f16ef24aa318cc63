#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.h"
#include "sim/config/whole_file.h"
#include "sim/flight/result_io.h"
#include "sim/record/table.h"
#include "sim/scenario/reference_path.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {
namespace {

constexpr double kStepS = 0.1;        // a vehicle at 10 m/s moves a meter
constexpr size_t kMaxPoints = 2'000;  // Frechet distance and time warping compare every pair

std::vector<TimedPoint> flown_path(const std::filesystem::path& run_folder) {
  const Table table(run_folder / "trajectory.csv");
  const auto t_s = table.numbers("t_s"), north_m = table.numbers("north_m"), east_m = table.numbers("east_m"),
             down_m = table.numbers("down_m");
  std::vector<TimedPoint> path;
  for (size_t i = 0; i < table.rows(); ++i) path.push_back({t_s[i], {north_m[i], east_m[i], down_m[i]}});
  return path;
}

struct ReferenceFile {
  std::filesystem::path path;
  std::string check;  ///< of the scenario that reads it, such as "checks.0"; empty: none
};

/// Returns the reference file of the scenario's path_tolerance; without such a check, a file next to the scenario.
ReferenceFile reference_file(const std::filesystem::path& run_folder, const std::string& scenario_file) {
  const Scenario scenario = load_scenario(run_folder / "scenario.yaml");
  for (size_t i = 0; i < scenario.checks.size(); ++i) {
    if (const auto* check = std::get_if<PathToleranceCheck>(&scenario.checks[i]))
      return {check->reference, fmt::format("checks.{}", i)};
  }
  if (scenario_file.empty())
    throw InputError(fmt::format("{}: its result.json names no scenario file", run_folder.string()));
  if (!std::filesystem::exists(scenario_file)) {  // relative to the folder from which the flight was started
    throw InputError(
        fmt::format("{}: no such scenario here; call bless in the folder in which run was called", scenario_file));
  }
  return {std::filesystem::path(scenario_file).replace_extension("reference.csv"), ""};
}

/// Returns why a flight cannot be a reference; empty if it can. Ignores path_tolerance, whose reference is replaced.
std::string failure_of(const FlightResult& result) {
  if (result.outcome == Outcome::collided || result.outcome == Outcome::fault)
    return std::string(to_string(result.outcome));
  for (const CheckResult& check : result.checks) {
    if (check.name != PathToleranceCheck::kName && !check.passed) return check.name;
  }
  return "";
}

}  // namespace

int bless(const BlessOptions& options) {
  if (options.reason.empty() || options.reason.find('\n') != std::string::npos) {
    throw InputError("--reason: give in one line why this path is the reference");
  }
  const std::string folder = options.folder.string();
  RunResult result;
  std::vector<TimedPoint> flown;
  try {
    result = read_result(options.folder / "result.json");
    flown = flown_path(options.folder);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: no whole run: {}", folder, error.what()));
  }
  if (flown.empty()) throw InputError(fmt::format("{}: the flight has no path", folder));
  const std::string failure = failure_of(result.flight);
  if (!failure.empty() && !options.force) {
    throw InputError(fmt::format("{}: the flight failed ({}); --force blesses it all the same", folder, failure));
  }
  const double duration_s = flown.back().t_s - flown.front().t_s;
  ReferencePath reference{.reason = options.reason,
                          .version = result.info.version,
                          .seed = result.info.seed,
                          .step_s = kStepS * std::max(1.0, std::ceil(duration_s / (kStepS * kMaxPoints)))};
  reference.points = thinned(flown, reference.step_s);
  const auto [file, check] = reference_file(options.folder, result.info.scenario_file);
  if (std::filesystem::exists(file) && !options.force) {
    throw InputError(fmt::format("{}: is there already; --force replaces it", file.string()));
  }
  if (!options.dry_run) write_file_whole(file, reference_text(reference));
  fmt::print("{}: {} ({} points)\n", options.dry_run ? "would write" : "written", file.string(),
             reference.points.size());
  if (check.empty()) {
    fmt::print("add to the checks: - {{check: path_tolerance, reference: {}, at_most: 0.5}}\n",
               file.filename().string());
  } else {
    fmt::print("checked by: {} of the scenario\n", check);
  }
  return 0;
}

}  // namespace hedgehop::sim::cli
