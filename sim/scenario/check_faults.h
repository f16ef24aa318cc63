#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A key of a scenario's checks, and what is wrong with it.
struct CheckFault {
  std::string path;  ///< such as checks.0.max
  std::string message;
};

/// What cannot be checked: bounds the wrong way round, names and files that do not exist, times after the flight.
std::vector<CheckFault> check_faults(const Scenario& scenario);

/// Names of a scenario's checks as its results have them, the implied one too.
std::vector<std::string> check_names(const Scenario& scenario);

}  // namespace hedgehop::sim
