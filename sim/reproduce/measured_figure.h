#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>

#include "sim/batch/statistics.h"
#include "sim/reproduce/outcome.h"

namespace hedgehop::sim {

/// A figure over flights, and how many of those that were asked for stand behind it.
struct MeasuredFigure {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< over the flights that have it; NaN when none has
  size_t asked = 0;
  size_t flown = 0;                  ///< left a result
  size_t faulted = 0;                ///< of those: ended by a fault, so that whatever they report does not count
  size_t with_figure = 0;            ///< of those without a fault
  size_t stand_ins = 0;              ///< of those with figure: the row's number stands in for it
  size_t unfinished = 0;             ///< of those without a fault: out of time before the goal
  std::optional<Interval> interval;  ///< of the share, Wilson 95 %; none for other statistics
  std::set<std::string> builds;      ///< that flew it
  std::set<std::string> truth_used;  ///< by any flight

  /// Whether every flight that was asked for has the figure.
  bool complete() const { return asked > 0 && with_figure == asked; }
  /// Whether every flight that was asked for was flown and ended without a fault.
  bool all_flown() const { return asked > 0 && flown == asked && faulted == 0; }
};

/// @param missing  as PaperRow::missing: a number stands in for the figure of a flight that has none.
MeasuredFigure measure(const FlightFigure& figure, const PaperOutcome& outcome, const std::string& missing = "fails");

/// "5 of 30", "1.234", "1.234 (28 of 30 flights)", "not measured".
std::string figure_words(const FlightFigure& figure, const MeasuredFigure& measured);

}  // namespace hedgehop::sim
