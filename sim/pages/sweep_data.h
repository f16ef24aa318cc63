#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"

namespace hedgehop::sim {

/// The points of a sweep, read from its table.
struct SweepTable {
  std::vector<std::string> paths;                ///< parameters
  std::vector<std::string> numbers;              ///< of the points, in the order of the table
  std::vector<std::vector<std::string>> values;  ///< of the parameters, one list per point
  std::vector<std::vector<size_t>> rows;         ///< of the table, one list per point
  std::vector<std::string> columns;              ///< of figures, without wall times
};
SweepTable sweep_points(const FlightList& flights);

/// Returns the means of a column over the seeds, one per point; NaN if a flight lacks the figure.
std::vector<double> point_means(const FlightList& flights, const SweepTable& points, const std::string& column);

/// Whether the means of a column differ, without those that are not finite.
bool varies(const std::vector<double>& means);

/// Returns sweep.json of a folder; an empty object without it.
nlohmann::ordered_json sweep_design(const std::filesystem::path& folder);

/// Returns the columns of which more is better: values of checks by the relation that they require, all others by name.
/// The column that an optimizer minimizes does not count.
/// @param folder  of the sweep. Without the flights' result.json, checks count by name, too.
std::set<std::string> more_is_better(const std::filesystem::path& folder, const FlightList& flights,
                                     const SweepTable& points);

/// Returns the design of a sweep for its page: `design`, `parameters` of {path, log}, `minimize` and `failure_cost` of
/// an optimizer, `more_is_better` (columns), `student` (factor of the 95 % interval by number of seeds), and `effects`:
/// `method` ("sobol", "grid" or null), `blocks`, and per column a list of [first, low, high, total, low, high] per
/// parameter. Null for a campaign that is no sweep.
/// @param folder  of the sweep, with sweep.json; without this file, the table gives the parameters.
nlohmann::ordered_json sweep_data(const std::filesystem::path& folder, const FlightList& flights);

}  // namespace hedgehop::sim
