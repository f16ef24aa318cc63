#pragma once

#include <filesystem>
#include <vector>

#include "sim/batch/record.h"
#include "sim/record/csv_table.h"

namespace hedgehop::sim {

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
