#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "sim/campaign/record.h"

namespace hedgehop::sim {

/// A field of a table: nothing, a number or a text.
using Cell = std::variant<std::monostate, int64_t, double, std::string>;

/// Rows of equal width under named columns.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

/// A column that a campaign adds beside the order's own, one cell a record.
struct ExtraColumn {
  std::string name;
  std::vector<Cell> cells;
};

/// One row a record, in their order: what was ordered, how it ended, the result's figures, the module's metrics
/// (`metric.NAME`; those of wall time `time.NAME`), the checks' values (`check.NAME`), the command that flies it again,
/// and last the columns that differ from run to run (those whose names begin with `time.`). Column names depend on the
/// records alone, never on the order in which flights ended.
Table flight_table(const std::vector<FlightRecord>& records, const std::vector<ExtraColumn>& extra = {});

/// The table as comma-separated values with a header line.
std::string csv_text(const Table& table);

/// Writes the table as table `flights` of an SQLite 3 file, aside and then renamed, so that a file that is there is
/// whole. Throws std::runtime_error naming the file and the cause.
void write_sqlite(const std::filesystem::path& file, const Table& table);

}  // namespace hedgehop::sim
