#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/batch/campaign_file.h"
#include "sim/batch/fly_orders.h"
#include "sim/batch/record.h"
#include "sim/cli/progress.h"
#include "sim/evidence/conduct.h"
#include "sim/evidence/sequential_count.h"

namespace hedgehop::sim::cli {

/// A batch that is ready to be flown.
struct BatchRun {
  BatchOrders batch;
  std::optional<StoppingRule> rule;
  Conduct conduct;
  FlyOptions fly;  ///< its folder is the batch's
  Reuse reuse = Reuse::none;
  bool again = false;  ///< an earlier batch's flights: so is its leaderboard
  std::filesystem::path junit;
  bool json = false;
  bool page = true;  ///< whether report.html is written
};

/// Flies orders, reuses the results that are there, and shows each end. Orders that were interrupted are missing.
std::vector<FlightRecord> fly_shown(const std::vector<Order>& orders, const FlyOptions& options,
                                    Interruption& interruption, CampaignProgress& progress);

/// Flies it, writes batch.json, batch.csv and the JUnit file, prints the results.
/// @return the exit status: 0 holds, 1 fails, 2 a file is bad, 4 undecided, 128 and the signal's number when
/// interrupted.
int fly_batch(BatchRun run);

/// Runs a command. If it throws InputError, writes the errors to the JUnit file, too. @param junit  empty: no file.
int reporting_bad_input(const std::filesystem::path& junit, const std::function<int()>& command);

/// Writes a file and its folders.
void write_junit(const std::filesystem::path& file, const std::string& text);

/// Prints the cause of each flight without a result, and the command that repeats it.
void print_failed(const std::vector<FlightRecord>& records);

/// Writes report.html of a batch or sweep and prints its path unless `quiet`. If the page cannot be written, prints the
/// error to standard error; the tables are not affected.
void write_campaign_page(const std::filesystem::path& folder, bool quiet = false);

}  // namespace hedgehop::sim::cli
