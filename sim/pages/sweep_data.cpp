#include "sim/pages/sweep_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "sim/batch/statistics.h"
#include "sim/config/input_error.h"
#include "sim/flight/json_file.h"
#include "sim/pages/campaign_data.h"
#include "sim/sweep/sensitivity.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

const std::set<std::string> kNoFigures = {"status", "outcome", "cause",      "trajectory_hash", "truth_used",
                                          "build",  "command", "robustness", "renderer",        "libraries"};

/// Returns the index of the point at each place of a full grid, the last parameter changing fastest; empty if the
/// points are no full grid. @param counts  gains the number of values of each parameter.
std::vector<size_t> grid_order(const SweepTable& points, std::vector<size_t>& counts) {
  std::vector<std::map<std::string, size_t>> levels(points.paths.size());
  for (const auto& values : points.values) {
    for (size_t p = 0; p < values.size(); ++p) levels[p].try_emplace(values[p], levels[p].size());
  }
  size_t size = 1;
  for (const auto& level : levels) {
    counts.push_back(level.size());
    size *= level.size();
    if (size > points.values.size()) return {};
  }
  if (size != points.values.size()) return {};
  std::vector<size_t> order(size, size);
  for (size_t i = 0; i < size; ++i) {
    size_t place = 0;
    for (size_t p = 0; p < counts.size(); ++p) place = place * counts[p] + levels[p].at(points.values[i][p]);
    order[place] = i;
  }
  return std::ranges::find(order, size) == order.end() ? order : std::vector<size_t>();
}

/// Returns the index of the point at each place of a Sobol design with indices; empty if a point is missing.
std::vector<size_t> sobol_order(const SweepTable& points, const Json& design) {
  std::map<std::string, size_t> by_number;
  for (size_t i = 0; i < points.numbers.size(); ++i) by_number[points.numbers[i]] = i;
  std::vector<size_t> order;
  for (const Json& number : design.at("points")) {
    const auto found = by_number.find(number.get<std::string>());
    if (found == by_number.end()) return {};
    order.push_back(found->second);
  }
  return order;
}

Json index_row(const SobolIndex& index) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  return {rounded(index.first), rounded(index.first_interval.low), rounded(index.first_interval.high),
          rounded(index.total), rounded(index.total_interval.low), rounded(index.total_interval.high)};
}

Json effects_data(const FlightList& flights, const SweepTable& points, const Json& design) {
  Json effects{{"method", nullptr}, {"blocks", 0}, {"columns", Json::object()}};
  std::vector<size_t> counts, order;
  const bool sobol = design.contains("block");
  order = sobol ? sobol_order(points, design) : grid_order(points, counts);
  if (order.size() < 2 || points.paths.size() < 2) return effects;
  effects["method"] = sobol ? "sobol" : "grid";
  if (sobol) effects["blocks"] = order.size() / (points.paths.size() + 2);
  for (const std::string& column : points.columns) {
    const std::vector<double> means = point_means(flights, points, column);
    if (std::ranges::any_of(means, [](double mean) { return std::isnan(mean); })) continue;
    std::vector<double> figures;
    for (const size_t point : order) figures.push_back(means[point]);
    const auto indices = sobol ? sobol_indices(figures, points.paths.size()) : grid_indices(figures, counts);
    if (indices.empty()) continue;
    for (const SobolIndex& index : indices) effects["columns"][column].push_back(index_row(index));
  }
  return effects;
}

/// Returns whether more is better, for the columns of checks. Checks that hold decide before checks that failed,
/// because a check that failed early may show another figure, such as the end of the flight.
std::map<std::string, bool> check_directions(const std::filesystem::path& folder, const FlightList& flights,
                                             const SweepTable& points) {
  std::map<std::string, bool> more, of_failed;
  const auto columns =
      std::ranges::count_if(points.columns, [](const std::string& name) { return name.starts_with("check."); });
  for (const FlightRecord& record : flights.records) {
    if (std::cmp_equal(more.size(), columns)) break;
    const std::filesystem::path file = folder / record.order.id / "result.json";
    if (record.status != FlightRecord::Status::flown || !std::filesystem::exists(file)) continue;
    try {
      const std::vector<CheckResult> checks = read_result(file).flight.checks;
      const std::vector<std::string> names = check_columns(checks);
      for (size_t i = 0; i < names.size(); ++i) {
        (checks[i].passed ? more : of_failed).try_emplace(names[i], checks[i].must != "<=");
      }
    } catch (const std::runtime_error&) {  // incomplete result.json: other flights decide
    }
  }
  more.merge(of_failed);
  return more;
}

}  // namespace

SweepTable sweep_points(const FlightList& flights) {
  SweepTable points{.paths = swept_columns(flights)};
  const Table& table = flights.table;
  std::vector<std::vector<std::string>> columns;
  for (const std::string& path : points.paths) columns.push_back(table.words(path));
  const std::vector<std::string> numbers = table.words("point");
  std::map<std::string, size_t> known;
  for (size_t row = 0; row < numbers.size(); ++row) {
    const auto [place, is_new] = known.try_emplace(numbers[row], points.numbers.size());
    if (is_new) {
      points.numbers.push_back(numbers[row]);
      points.rows.emplace_back();
      points.values.emplace_back();
      for (const auto& column : columns) points.values.back().push_back(column[row]);
    }
    points.rows[place->second].push_back(row);
  }
  const auto& names = table.names();
  for (auto name = std::ranges::find(names, "status"); name != names.end(); ++name) {
    if (!kNoFigures.contains(*name) && !name->starts_with("time.")) points.columns.push_back(*name);
  }
  return points;
}

std::vector<double> point_means(const FlightList& flights, const SweepTable& points, const std::string& column) {
  const std::vector<double> numbers = flights.table.numbers(column);
  std::vector<double> means;
  for (const std::vector<size_t>& rows : points.rows) {
    double sum = 0.0;
    for (const size_t row : rows) sum += numbers[row];  // a NaN makes the mean NaN
    means.push_back(sum / static_cast<double>(rows.size()));
  }
  return means;
}

bool varies(const std::vector<double>& means) {
  double low = INFINITY, high = -INFINITY;
  for (const double mean : means) {
    if (std::isfinite(mean)) low = std::min(low, mean), high = std::max(high, mean);
  }
  return low < high;
}

Json sweep_design(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "sweep.json";
  if (!std::filesystem::exists(file)) return Json::object();
  Json design = read_json(file);
  if (!design.is_object()) throw InputError(file.string() + ": is not the record of a sweep; fly the sweep again");
  return design;
}

std::set<std::string> more_is_better(const std::filesystem::path& folder, const FlightList& flights,
                                     const SweepTable& points) {
  constexpr std::array kWords = {"clearance",    "passed", "success",     "progress",          "goal_velocity",
                                 "precision",    "found",  "visited",     "time_to_collision", "corners_seen",
                                 "no_collision", "valid_", "_known_share"};
  const std::string minimized = sweep_design(folder).value("minimize", "");
  const auto of_checks = check_directions(folder, flights, points);
  std::set<std::string> columns;
  for (const std::string& column : points.columns) {
    const auto check = of_checks.find(column);
    const bool more = check != of_checks.end() ? check->second : std::ranges::any_of(kWords, [&](const char* word) {
      return column.find(word) != std::string::npos;
    });
    if (more && column != minimized) columns.insert(column);
  }
  return columns;
}

Json sweep_data(const std::filesystem::path& folder, const FlightList& flights) {
  if (!flights.is_sweep || std::filesystem::exists(folder / "falsify.csv") || swept_columns(flights).empty()) {
    return nullptr;
  }
  const SweepTable points = sweep_points(flights);
  const Json design = sweep_design(folder);
  Json data{{"design", design.value("design", "")}, {"parameters", design.value("parameters", Json::array())}};
  if (design.contains("minimize")) {
    data["minimize"] = design["minimize"];
    data["failure_cost"] = design["failure_cost"];
  }
  data["more_is_better"] = more_is_better(folder, flights, points);
  data["student"] = Json::object();
  for (const auto& rows : points.rows) {
    const std::string count = std::to_string(rows.size());
    if (rows.size() < 2 || data["student"].contains(count)) continue;
    data["student"][count] = student_factor(static_cast<int64_t>(rows.size()), kTableConfidence);
  }
  data["effects"] = effects_data(flights, points, design);
  return data;
}

}  // namespace hedgehop::sim
