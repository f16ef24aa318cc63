#pragma once

#include <string>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// The check of a flight that is nearest to failing, or fails by most.
struct WeakestCheck {
  std::string name;         ///< "flight" of one that crashed, hung or ended by a fault
  double robustness = 0.0;  ///< < 0 exactly where it fails
};

/// The margin of each check to its limit: in m and m/s as it is, of times over 10 s, of angles over 0.1 rad, so that
/// they compare. A flight that the scenario refuses (exit status 2) has nothing to check and passes by far.
/// @param names  of the checks that count; all when empty.
WeakestCheck weakest_check(const FlightRecord& record, const std::vector<std::string>& names);

/// Robustness of one check of result.json.
double check_robustness(const nlohmann::ordered_json& check);

/// When a check of a flight was decided, s; the flight's end where that is not known, infinity without a result.
double decided_s(const FlightRecord& record, const std::string& check);

}  // namespace hedgehop::sim
