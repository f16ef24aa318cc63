#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/record.h"
#include "sim/record/table.h"

namespace hedgehop::sim {

/// Returns one row per record, in their order: the order, the outcome, the figures of the result, the metrics
/// (`metric.NAME`), the values of the checks (`check.NAME`), the re-run command, and last the columns of
/// FigureKind::wall_time with their metrics (`time.NAME`). Columns depend on the records alone, never on the order in
/// which flights ended. `passed` is 1 or 0, and empty for flights without checks and flights that are missing.
Table flight_table(const std::vector<FlightRecord>& records, const std::vector<Table::Column>& extra = {});

/// Returns the column of each check. Checks of one name get numbers from the second on (`check.NAME.2`), because a
/// scenario may check a thing twice.
std::vector<std::string> check_columns(const std::vector<CheckResult>& checks);

/// Returns a judged figure of a result by its column of flight_table(), or none for an unknown name. A clearance is
/// infinite if no obstacle was within the search range.
std::optional<double> figure_of(const FlightResult& result, std::string_view column);

/// Returns why a table of flights of the scenario lacks a column of numbers, with the nearest names; "" if the column
/// is possible. The metrics of a module are unknown before the flight, so their names are not judged.
std::string column_fault(const std::string& column, const Scenario& scenario);

/// The flights of a campaign's folder.
struct FlightList {
  bool is_sweep = false;              ///< or a search: its points have columns of their own
  Table table;                        ///< sweep.csv, falsify.csv or batch.csv
  std::vector<FlightRecord> records;  ///< one per row, read from the table; sufficient for summarize()
};

/// Whether the folder is a batch's, a sweep's or a search's.
bool is_campaign(const std::filesystem::path& folder);

/// Reads the flights of a campaign's folder. Throws InputError naming the folder when it has no table of flights, and
/// std::runtime_error naming file, line and cause when the table is malformed.
FlightList read_flights(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
