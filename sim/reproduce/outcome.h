#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/campaign/record.h"
#include "sim/reproduce/calculations.h"
#include "sim/reproduce/paper.h"

namespace hedgehop::sim {

/// The orders of a paper's flights, one a flight; ids begin with the flights' name. Throws InputError with every fault.
/// @param quick  only the seeds of a quick look.
std::vector<Order> paper_orders(const Paper& paper, bool quick);

/// Results of a paper's flights and calculations.
struct PaperOutcome {
  Paper paper;
  std::filesystem::path folder;  ///< each flight's is <folder>/<order.id>
  std::map<std::string, std::vector<FlightRecord>> flights;
  std::map<std::string, Columns> calculations;
};

/// Sorts records by the flights they belong to, and does the calculations that the paper asks for.
PaperOutcome paper_outcome(const Paper& paper, const std::filesystem::path& folder,
                           const std::vector<FlightRecord>& records);

/// A figure over flights; NaN where none of them ended or has the column.
double figure_of(const FlightFigure& figure, const PaperOutcome& outcome);

/// A row of a paper beside ours.
struct RowOutcome {
  PaperRow row;
  double value = std::numeric_limits<double>::quiet_NaN();
  size_t ended = 0;           ///< flights it was taken from
  size_t broken = 0;          ///< flights that left no result
  std::optional<bool> holds;  ///< none without a requirement or a measurement; never with a broken flight
  std::string asked, ours;    ///< words: "at most 0", "0 of 100"
  std::string command;        ///< re-simulates it; empty for a calculation
};
std::vector<RowOutcome> row_outcomes(const PaperOutcome& outcome);

/// A paper's rows for people and documents: a heading and a table in Markdown.
std::string rows_text(const Paper& paper, const std::vector<RowOutcome>& rows);

/// Rows of all papers as comma-separated values with a header line.
std::string rows_csv(const std::vector<std::pair<std::string, std::vector<RowOutcome>>>& rows_of_papers);

}  // namespace hedgehop::sim
