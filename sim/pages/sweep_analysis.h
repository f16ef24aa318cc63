#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/pages/sweep_data.h"

namespace hedgehop::sim {

/// The mean of a column over the seeds of a point.
struct PointFigure {
  double mean = 0.0;             ///< NaN if a flight lacks the figure
  double low = 0.0, high = 0.0;  ///< 95 % interval over the seeds: Student, or Wilson of `passed`; NaN for one seed
  size_t passed = 0, flights = 0;
  size_t unchecked = 0;  ///< flights without checks
  size_t missing = 0;    ///< flights not flown

  /// Whether no flight failed. Flights without checks count as passed for the order only.
  bool none_failed() const { return passed + unchecked == flights; }
};

/// The ranking of a sweep's points by a column.
struct SweepAnalysis {
  SweepTable points;
  std::string column;
  std::map<std::string, std::string> labels;  ///< columns and parameters with units: "min_obstacle_clearance, m"
  bool less = true;                           ///< whether less is better
  std::vector<PointFigure> figures;           ///< one per point
  std::vector<size_t> ranking;  ///< points without failed flights first, then by the mean, then by the clearance
  std::set<std::string> more_is_better;  ///< columns
  std::vector<bool> log;                 ///< per parameter: whether its range is logarithmic

  const std::string& label() const { return labels.at(column); }
};

/// @param column  empty: the minimized column of an optimizer, else `passed` if it varies, else the clearance.
/// Throws InputError for an unknown column, with the nearest name.
SweepAnalysis analyze_sweep(const std::filesystem::path& folder, const FlightList& flights, std::string column);

/// Returns the figures of another column. Throws as analyze_sweep().
std::vector<PointFigure> point_figures(const FlightList& flights, const SweepTable& points, const std::string& column);

/// Writes tables (LaTeX with booktabs, and CSV) and figures (SVG and PDF) of a sweep for a paper.
/// @param out  folder, created if necessary. @return the names of the files.
std::vector<std::string> write_sweep_figures(const std::filesystem::path& folder, const std::filesystem::path& out,
                                             const std::string& column);

}  // namespace hedgehop::sim
