#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>

#include "sim/batch/statistics.h"
#include "sim/reproduce/outcome.h"

namespace hedgehop::sim {

/// A figure over flights, with the number of flights that it is based on.
struct MeasuredFigure {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< over the flights that have it; NaN if no flight has it
  size_t required = 0;
  size_t flown = 0;                  ///< with a result
  size_t faulted = 0;                ///< of those: ended by a fault; their figures do not count
  size_t with_figure = 0;            ///< of those without a fault
  size_t stand_ins = 0;              ///< of those with figure: the row's number replaces it
  size_t unfinished = 0;             ///< of those without a fault: timed out before the goal
  std::optional<Interval> interval;  ///< of the share, Wilson 95 %; none for other statistics
  std::set<std::string> builds;      ///< that flew it
  std::set<std::string> truth_used;  ///< by any flight

  /// Returns whether every required flight has the figure.
  bool complete() const { return required > 0 && with_figure == required; }
  /// Returns whether every required flight was flown and ended without a fault.
  bool all_flown() const { return required > 0 && flown == required && faulted == 0; }
};

/// @param missing  as PaperRow::missing: a number replaces the figure of a flight without one.
MeasuredFigure measure(const FlightFigure& figure, const PaperOutcome& outcome, const std::string& missing = "fails");

/// Returns "5 of 30", "1.234", "1.234 (28 of 30 flights)", "not measured".
/// @param other  bound next to it, as in distinct_figures(); NaN if there is none.
std::string figure_words(const FlightFigure& figure, const MeasuredFigure& measured, double other);

}  // namespace hedgehop::sim
