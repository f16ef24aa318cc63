#pragma once

#include <filesystem>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim::cli {

/// Prints the cause of each flight without a result, and the command that repeats it.
void print_failed(const std::vector<FlightRecord>& records);

/// Writes report.html of a batch or sweep and prints its path. If the page cannot be written, prints the error to
/// standard error; the tables are not affected.
void write_campaign_page(const std::filesystem::path& folder);

}  // namespace hedgehop::sim::cli
