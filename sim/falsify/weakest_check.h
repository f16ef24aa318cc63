#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// The check of a flight with the smallest robustness.
struct WeakestCheck {
  std::string name;         ///< "flight" if the flight ended with a fault
  double robustness = 0.0;  ///< < 0 if and only if the check fails
};

/// Returns the check with the smallest margin to its limit. To make margins comparable, times are divided by 10 s and
/// angles by 0.1 rad; values in m and m/s are used unscaled.
/// @param names  of the checks that count; all if empty.
/// @return nullopt if the flight was not flown: it neither passed nor failed.
std::optional<WeakestCheck> weakest_check(const FlightRecord& record, const std::vector<std::string>& names);

/// Returns the robustness of one check.
double check_robustness(const CheckResult& check);

/// Returns the time at which a check was decided, s: the end of the flight if unknown, infinity without a result.
double decided_s(const FlightRecord& record, const std::string& check);

}  // namespace hedgehop::sim
