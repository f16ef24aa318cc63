#pragma once

#include <filesystem>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim::cli {

/// Prints why each flight that could not be flown failed, and the command to fly it again.
void print_failed(const std::vector<FlightRecord>& records);

/// Writes report.html of a batch or sweep that has just been flown, and prints its name. A page that cannot be made is
/// told on standard error: the tables stand without it.
void write_campaign_page(const std::filesystem::path& folder);

}  // namespace hedgehop::sim::cli
