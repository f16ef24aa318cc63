#include "sim/pages/sweep_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "sim/batch/statistics.h"
#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

constexpr const char* kClearance = "min_obstacle_clearance_m";

bool has_column(const SweepTable& points, const std::string& name) {
  return std::ranges::find(points.columns, name) != points.columns.end();
}

/// As the page chooses it.
std::string default_column(const std::filesystem::path& folder, const FlightList& flights, const SweepTable& points) {
  if (const auto file = folder / "sweep.json"; std::filesystem::exists(file)) {
    const auto design = nlohmann::ordered_json::parse(read_file_whole(file));
    const std::string minimize = design.value("minimize", "");
    if (has_column(points, minimize)) return minimize;
  }
  const std::vector<double> passed = point_means(flights, points, "passed");
  const auto [low, high] = std::ranges::minmax(passed);
  return low < high || !has_column(points, kClearance) ? "passed" : kClearance;
}

std::string label_of(const std::string& column) {
  constexpr std::array kUnits = {std::pair{"_mps", "m/s"}, std::pair{"_m", "m"}, std::pair{"_s", "s"}};
  for (const auto& [ending, unit] : kUnits) {
    if (column.ends_with(ending)) return column.substr(0, column.rfind('_')) + ", " + unit;
  }
  return column;
}

}  // namespace

bool more_is_better(const std::string& column) {
  constexpr std::array kWords = {"clearance",     "passed",    "success", "progress",
                                 "goal_velocity", "precision", "found",   "share"};
  return std::ranges::any_of(kWords, [&](const char* word) { return column.find(word) != std::string::npos; });
}

std::vector<PointFigure> point_figures(const FlightList& flights, const SweepTable& points, const std::string& column) {
  const std::vector<double> numbers = flights.table.numbers(column), means = point_means(flights, points, column);
  std::vector<PointFigure> figures;
  for (size_t i = 0; i < points.rows.size(); ++i) {
    const std::vector<size_t>& rows = points.rows[i];
    PointFigure& figure =
        figures.emplace_back(PointFigure{.mean = means[i], .low = NAN, .high = NAN, .flights = rows.size()});
    double squares = 0.0;
    for (const size_t row : rows) {
      squares += (numbers[row] - figure.mean) * (numbers[row] - figure.mean);
      const Verdict verdict = verdict_of(flights.records[row]);
      figure.passed += verdict == Verdict::passed || verdict == Verdict::unchecked ? 1 : 0;
    }
    const auto n = static_cast<double>(rows.size());
    if (std::isnan(figure.mean)) continue;
    if (column == "passed") {
      const Count count{std::llround(figure.mean * n), static_cast<int64_t>(rows.size())};
      const Interval interval = wilson_interval(count, kTableConfidence);
      figure.low = interval.low;
      figure.high = interval.high;
    } else if (rows.size() > 1) {
      const double half =
          student_factor(static_cast<int64_t>(rows.size()), kTableConfidence) * std::sqrt(squares / (n - 1.0) / n);
      figure.low = figure.mean - half;
      figure.high = figure.mean + half;
    }
  }
  return figures;
}

SweepAnalysis analyze_sweep(const std::filesystem::path& folder, const FlightList& flights, std::string column) {
  SweepAnalysis analysis{.points = sweep_points(flights)};
  SweepTable& points = analysis.points;
  if (column.empty()) column = default_column(folder, flights, points);
  if (!has_column(points, column)) {
    for (const std::string& name : points.columns) {
      if (name.ends_with("." + column))
        throw InputError("--column: no column '" + column + "'; did you mean '" + name + "'?");
    }
    throw InputError("--column: no column '" + column + "'" +
                     suggestion(column, {points.columns.begin(), points.columns.end()}));
  }
  analysis.column = column;
  analysis.label = label_of(column);
  analysis.less = !more_is_better(column);
  analysis.figures = point_figures(flights, points, column);
  const std::vector<double> clearance = has_column(points, kClearance) ? point_means(flights, points, kClearance)
                                                                       : std::vector<double>(points.rows.size());
  const auto key = [&](size_t i) {
    const PointFigure& figure = analysis.figures[i];
    const double cost = std::isnan(figure.mean) ? INFINITY : analysis.less ? figure.mean : -figure.mean;
    return std::tuple(figure.passed < figure.flights, cost, std::isnan(clearance[i]) ? 0.0 : -clearance[i], i);
  };
  analysis.ranking.resize(points.rows.size());
  std::iota(analysis.ranking.begin(), analysis.ranking.end(), size_t{0});
  std::ranges::sort(analysis.ranking, [&](size_t a, size_t b) { return key(a) < key(b); });
  return analysis;
}

}  // namespace hedgehop::sim
