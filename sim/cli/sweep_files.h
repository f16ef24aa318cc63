#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/commands.h"
#include "sim/cli/every_write.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim::cli {

struct SweepRun {
  const SweepOptions& options;
  SweepConfig sweep;
  std::filesystem::path out;
  std::string name = "sweep";  ///< of the tables, without their ending
};

/// The flights that have ended: rows of the table, and records for the summary.
struct FlownSweep {
  Table table;
  std::vector<FlightRecord> records;

  /// @param whole  whether to store whole records, as the JUnit file needs them.
  void add(const SweepConfig& sweep, const SweepOrders& orders, std::vector<FlightRecord> more, bool whole);
};

/// Writes the tables, the design that the page needs in addition, and the JUnit file.
/// @param design_points  number of each point in its design @param block  points per block; 0: no blocks
EveryWrite write_sweep(const SweepRun& run, const FlownSweep& flown, const std::vector<std::string>& design_points,
                       size_t block);

/// Writes report.html; above a limit, warns instead.
void write_sweep_page(const SweepRun& run, size_t flights);

}  // namespace hedgehop::sim::cli
