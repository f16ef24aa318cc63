#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/record.h"
#include "sim/record/table.h"

namespace hedgehop::sim {

/// One row a record, in their order: what was ordered, how it ended, the result's figures, the metrics (`metric.NAME`),
/// the checks' values (`check.NAME`), the command that flies it again, and last the columns of FigureKind::wall_time,
/// metrics among them (`time.NAME`). Columns depend on the records alone, never on the order in which flights ended.
Table flight_table(const std::vector<FlightRecord>& records, const std::vector<Table::Column>& extra = {});

/// A judged figure of a result by its column of flight_table(), as a number; none for another name. A clearance is
/// infinite if nothing was within reach.
std::optional<double> figure_of(const FlightResult& result, std::string_view column);

/// What a campaign's folder holds of its flights.
struct FlightList {
  bool is_sweep = false;              ///< or a search: its points have columns of their own
  Table table;                        ///< sweep.csv, falsify.csv or batch.csv
  std::vector<FlightRecord> records;  ///< one a row: from the table, enough for summarize()
};

/// Whether the folder is a batch's, a sweep's or a search's.
bool is_campaign(const std::filesystem::path& folder);

/// Reads the flights of a campaign's folder. Throws InputError naming the folder when it has no table of flights, and
/// std::runtime_error naming file, line and cause when the table is malformed.
FlightList read_flights(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
