#include "sim/pages/sweep_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "sim/batch/statistics.h"
#include "sim/config/input_error.h"
#include "sim/pages/campaign_data.h"

namespace hedgehop::sim {
namespace {

constexpr const char* kClearance = "min_obstacle_clearance_m";

bool has_column(const SweepTable& points, const std::string& name) {
  return std::ranges::find(points.columns, name) != points.columns.end();
}

/// As the page chooses it.
std::string default_column(const nlohmann::ordered_json& design, const FlightList& flights, const SweepTable& points) {
  if (const std::string minimize = design.value("minimize", ""); has_column(points, minimize)) return minimize;
  const bool by_passed = varies(point_means(flights, points, "passed")) || !has_column(points, kClearance);
  return by_passed ? "passed" : kClearance;
}

/// Returns per parameter whether its range is logarithmic.
std::vector<bool> log_ranges(const nlohmann::ordered_json& design, const SweepTable& points) {
  std::vector<bool> log(points.paths.size(), false);
  for (const auto& parameter : design.value("parameters", nlohmann::ordered_json::array())) {
    const auto path = std::ranges::find(points.paths, parameter.at("path").get<std::string>());
    if (path != points.paths.end()) log[static_cast<size_t>(path - points.paths.begin())] = parameter.at("log");
  }
  return log;
}

std::string label_of(const std::string& column, const std::vector<FlightNotes>& notes) {
  constexpr std::array kUnits = {std::pair{"_mps", "m/s"}, std::pair{"_m", "m"}, std::pair{"_s", "s"}};
  for (const auto& [ending, unit] : kUnits) {
    if (column.ends_with(ending)) return column.substr(0, column.rfind('_')) + ", " + unit;
  }
  const std::string unit = unit_of_column(column, notes);
  return unit.empty() ? column : column + ", " + unit;
}

}  // namespace

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
      figure.passed += verdict == Verdict::passed ? 1 : 0;
      figure.unchecked += verdict == Verdict::unchecked ? 1 : 0;
      figure.missing += flights.records[row].status == FlightRecord::Status::missing ? 1 : 0;
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
  const nlohmann::ordered_json design = sweep_design(folder);
  if (column.empty()) column = default_column(design, flights, points);
  if (!has_column(points, column)) {
    for (const std::string& name : points.columns) {
      if (name.ends_with("." + column))
        throw InputError("--column: no column '" + column + "'; did you mean '" + name + "'?");
    }
    throw InputError("--column: no column '" + column + "'" +
                     suggestion(column, {points.columns.begin(), points.columns.end()}));
  }
  analysis.column = column;
  const std::vector<FlightNotes> notes = read_notes(folder, flights.records);
  for (const auto& names : {points.paths, points.columns}) {
    for (const std::string& name : names) analysis.labels[name] = label_of(name, notes);
  }
  analysis.more_is_better = more_is_better(folder, flights, points);
  analysis.less = !analysis.more_is_better.contains(column);
  analysis.log = log_ranges(design, points);
  analysis.figures = point_figures(flights, points, column);
  const std::vector<double> clearance = has_column(points, kClearance) ? point_means(flights, points, kClearance)
                                                                       : std::vector<double>(points.rows.size());
  const auto key = [&](size_t i) {
    const PointFigure& figure = analysis.figures[i];
    const double cost = std::isnan(figure.mean) ? INFINITY : analysis.less ? figure.mean : -figure.mean;
    return std::tuple(!figure.none_failed(), cost, std::isnan(clearance[i]) ? 0.0 : -clearance[i], i);
  };
  analysis.ranking.resize(points.rows.size());
  std::iota(analysis.ranking.begin(), analysis.ranking.end(), size_t{0});
  std::ranges::sort(analysis.ranking, [&](size_t a, size_t b) { return key(a) < key(b); });
  return analysis;
}

}  // namespace hedgehop::sim
