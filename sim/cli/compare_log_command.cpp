#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cli/exit_status.h"
#include "sim/cli/log_commands.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_files.h"
#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/fields/quantities.h"
#include "sim/flightlog/log_comparison.h"
#include "sim/flightlog/recorded_flight.h"
#include "sim/pages/log_figure.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A state or a group of states with the unit that people read.
struct ReadableRow {
  std::string_view name, unit;
  double scale;
  double model, held, constant_velocity, linear;
};

std::vector<ReadableRow> readable_rows(const HorizonErrors& row, bool has_position) {
  const std::array<Eigen::Vector4d, 4> groups = {group_norms(row.model), group_norms(row.held),
                                                 group_norms(row.constant_velocity), group_norms(row.linear)};
  std::vector<ReadableRow> all;
  for (Eigen::Index g = has_position ? 0 : 1; g < 4; ++g) {
    const double scale = g >= 2 ? kDegPerRad : 1.0;
    const std::string_view unit = kGroupUnits[static_cast<size_t>(g)];
    for (Eigen::Index k = kPerGroup * g; k < kPerGroup * (g + 1); ++k) {
      all.push_back({kStateNames[static_cast<size_t>(k)], unit, scale, scale * row.model[k], scale * row.held[k],
                     scale * row.constant_velocity[k], scale * row.linear[k]});
    }
    all.push_back({kStateGroups[static_cast<size_t>(g)], unit, scale, scale * groups[0][g], scale * groups[1][g],
                   scale * groups[2][g], scale * groups[3][g]});
  }
  return all;
}

void print_table(const LogComparison& comparison) {
  fmt::print("inputs: {}\n", LogColumnsConfig::kInputNames.at(static_cast<size_t>(comparison.inputs)));
  for (const HorizonErrors& row : comparison.rows) {
    fmt::print("horizon {} s, {} windows: RMSE\n{:>18}{:>12}{:>12}{:>20}{:>16}\n", row.horizon_s, row.windows, "state",
               "model", "unchanged", "constant velocity", "linear model");
    for (const ReadableRow& s : readable_rows(row, comparison.has_position)) {
      fmt::print("{:>18}{:>12.4f}{:>12.4f}{:>20.4f}{:>16.4f}\n", fmt::format("{} [{}]", s.name, s.unit), s.model,
                 s.held, s.constant_velocity, s.linear);
    }
  }
  if (comparison.force_rmse_n) {
    fmt::print("force at the measured states: RMSE {:.4f} N over {} samples\n", *comparison.force_rmse_n,
               comparison.force_samples);
  }
}

void print_csv(const LogComparison& comparison) {
  fmt::print("horizon_s,windows,state,unit,model,unchanged,constant_velocity,linear\n");
  for (const HorizonErrors& row : comparison.rows) {
    for (const ReadableRow& s : readable_rows(row, comparison.has_position)) {
      fmt::print("{},{},{},{},{},{},{},{}\n", row.horizon_s, row.windows, s.name, s.unit, s.model, s.held,
                 s.constant_velocity, s.linear);
    }
  }
}

Json comparison_json(const LogComparison& comparison) {
  Json rows = Json::array();
  for (const HorizonErrors& row : comparison.rows) {
    Json states = Json::object();
    for (const ReadableRow& s : readable_rows(row, comparison.has_position)) {
      states[std::string(s.name)] = {{"unit", s.unit},
                                     {"model", s.model},
                                     {"unchanged", s.held},
                                     {"constant_velocity", s.constant_velocity},
                                     {"linear", s.linear}};
    }
    rows.push_back({{"horizon_s", row.horizon_s}, {"windows", row.windows}, {"rmse", states}});
  }
  Json json = {{"horizons", rows}};
  if (comparison.force_rmse_n) {
    json["force_rmse_n"] = *comparison.force_rmse_n;
    json["force_samples"] = comparison.force_samples;
  }
  return json;
}

LogComparison compare_files(const dynamics::VehicleConfig& vehicle, const CompareLogOptions& options) {
  const LogColumnsConfig columns = options.columns.empty() ? LogColumnsConfig{} : read_log_columns(options.columns);
  std::vector<RecordedFlight> flights;
  for (const std::filesystem::path& log : options.logs) {
    flights.push_back(read_recorded_flight(log, columns, vehicle));
    if (!flights.back().takes_positions_for_commands) continue;
    warn(
        fmt::format("{} is a table of Hedgehop, whose controls are positions that servos or motors have reached; they "
                    "count as commands; --columns MAP.yaml with inputs: control_positions replays them",
                    log.string()));
  }
  const LogShare share = options.part == "first"    ? LogShare::first
                         : options.part == "second" ? LogShare::second
                                                    : LogShare::all;
  std::vector<double> horizons_s = options.horizons_s;
  std::ranges::sort(horizons_s);
  LogComparison comparison = compare_logs(
      vehicle, flights, {.horizons_s = horizons_s, .every_s = options.every_s, .share = share, .split = options.split});
  for (const double horizon_s : horizons_s) {
    if (std::ranges::find(comparison.rows, horizon_s, &HorizonErrors::horizon_s) != comparison.rows.end()) continue;
    warn(fmt::format("no window of {} s fits into the logs without a pause", horizon_s));
  }
  return comparison;
}

}  // namespace

int compare_log(const CompareLogOptions& options) {
  if (!options.plot.empty()) require_writable_file(options.plot);
  const LogComparison comparison =
      about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) { return compare_files(vehicle, options); });
  if (options.json) {
    fmt::print("{}\n", json_text(comparison_json(comparison), 2));
  } else if (options.csv) {
    print_csv(comparison);
  } else {
    print_table(comparison);
  }
  if (!options.plot.empty()) write_plot(options.plot, log_figure(comparison));
  return 0;
}

}  // namespace hedgehop::sim::cli
