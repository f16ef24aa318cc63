#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/batch/record.h"
#include "sim/reproduce/calculations.h"
#include "sim/reproduce/paper.h"

namespace hedgehop::sim {

/// Returns the orders of a paper, one per flight; ids begin with the flights' name. Throws InputError with every fault.
/// @param quick  only the seeds of a quick run.
std::vector<Order> paper_orders(const Paper& paper, bool quick);

/// Results of a paper's flights and calculations.
struct PaperOutcome {
  Paper paper;
  std::filesystem::path folder;  ///< each flight's is <folder>/<order.id>
  std::map<std::string, std::vector<FlightRecord>> flights;
  std::map<std::string, Columns> calculations;
};

/// Groups records by their flights, and performs the paper's calculations.
PaperOutcome paper_outcome(const Paper& paper, const std::filesystem::path& folder,
                           const std::vector<FlightRecord>& records);

}  // namespace hedgehop::sim
