#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/batch/record.h"
#include "sim/flight/flight.h"
#include "sim/record/csv_table.h"

namespace hedgehop::sim {

/// A field of a table: nothing, a number or a text.
using Cell = std::variant<std::monostate, int64_t, double, std::string>;

struct TableColumn {
  std::string name;
  std::string unit;                ///< "" for none, or unknown
  std::optional<FigureKind> kind;  ///< none for what was ordered and how it ended
};

/// Rows of equal width under named columns.
struct Table {
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;
};

/// A column that a campaign adds beside the order's own, one cell a record.
struct ExtraColumn {
  std::string name;
  std::vector<Cell> cells;
};

/// One row a record, in their order: what was ordered, how it ended, the result's figures, the metrics (`metric.NAME`),
/// the checks' values (`check.NAME`), the command that flies it again, and last the columns of FigureKind::wall_time,
/// metrics among them (`time.NAME`). Columns depend on the records alone, never on the order in which flights ended.
Table flight_table(const std::vector<FlightRecord>& records, const std::vector<ExtraColumn>& extra = {});

/// Index of a column; columns.size() when it is missing.
size_t column_index(const Table& table, std::string_view name);

/// The table as comma-separated values with a header line.
std::string csv_text(const Table& table);

/// What a campaign's folder holds of its flights.
struct FlightList {
  bool is_sweep = false;              ///< or a search: its points have columns of their own
  CsvTable table;                     ///< sweep.csv, falsify.csv or batch.csv
  std::vector<FlightRecord> records;  ///< one a row: from the table, enough for summarize()
};

/// Whether the folder is a batch's, a sweep's or a search's.
bool is_campaign(const std::filesystem::path& folder);

/// Reads the flights of a campaign's folder. Throws InputError naming the folder when it has no table of flights, and
/// std::runtime_error naming file, line and cause when the table is malformed.
FlightList read_flights(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
