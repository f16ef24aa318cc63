#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.h"
#include "sim/record/csv_table.h"
#include "sim/record/whole_file.h"
#include "sim/scenario/reference_path.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {
namespace {

constexpr double kStepS = 0.1;         // a vehicle at 10 m/s moves a meter
constexpr size_t kMostPoints = 2'000;  // Frechet distance and time warping compare every pair

std::vector<TimedPoint> flown_path(const std::filesystem::path& run_folder) {
  const CsvTable table(run_folder / "trajectory.csv");
  const auto t_s = table.numbers("t_s"), north_m = table.numbers("north_m"), east_m = table.numbers("east_m"),
             down_m = table.numbers("down_m");
  std::vector<TimedPoint> path;
  for (size_t i = 0; i < table.rows(); ++i) path.push_back({t_s[i], {north_m[i], east_m[i], down_m[i]}});
  return path;
}

/// Where the scenario looks for its reference, or, without such a check, beside the scenario's file.
std::filesystem::path reference_file(const std::filesystem::path& run_folder, const std::string& scenario_file) {
  const Scenario scenario = load_scenario(run_folder / "scenario.yaml");
  for (const CheckConfig& check : scenario.checks) {
    if (const auto* path = std::get_if<PathToleranceCheck>(&check)) return path->reference;
  }
  if (scenario_file.empty())
    throw InputError(fmt::format("{}: its result.json names no scenario file", run_folder.string()));
  return std::filesystem::path(scenario_file).replace_extension("reference.csv");
}

}  // namespace

int bless(const std::filesystem::path& run_folder, const std::string& reason) {
  if (reason.empty() || reason.find('\n') != std::string::npos) {
    throw InputError("--reason: give in one line why this path is the reference");
  }
  nlohmann::ordered_json result;
  std::vector<TimedPoint> flown;
  try {
    result = nlohmann::ordered_json::parse(read_file_whole(run_folder / "result.json"));
    flown = flown_path(run_folder);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: no whole run: {}", run_folder.string(), error.what()));
  }
  if (flown.empty()) throw InputError(fmt::format("{}: the flight has no path", run_folder.string()));
  const double duration_s = flown.back().t_s - flown.front().t_s;
  ReferencePath reference{.reason = reason,
                          .version = result.value("version", ""),
                          .seed = result.value("seed", uint64_t{0}),
                          .step_s = kStepS * std::max(1.0, std::ceil(duration_s / (kStepS * kMostPoints)))};
  reference.points = thinned(flown, reference.step_s);
  const std::filesystem::path file = reference_file(run_folder, result.value("scenario_file", ""));
  write_file_whole(file, reference_text(reference));
  fmt::print("written: {} ({} points)\nchecked by: - {{check: path_tolerance, reference: {}, at_most: 0.5}}\n",
             file.string(), reference.points.size(), file.filename().string());
  return 0;
}

}  // namespace hedgehop::sim::cli
