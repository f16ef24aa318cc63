#pragma once

#include <string>
#include <vector>

#include "sim/falsify/falsify_file.h"
#include "sim/falsify/weakest_check.h"
#include "sim/sweep/optimize.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim {

/// A point that was flown.
struct FalsifyTrial {
  std::vector<double> coordinates;  ///< of the unit cube, one a parameter of the search's sweep
  std::vector<std::string> values;
  size_t generation = 0;  ///< 0 for random points
  WeakestCheck weakest;   ///< of all seeds
  size_t record = 0;      ///< number of the flight that has it

  bool fails() const { return weakest.robustness < 0.0; }
};

/// What a search has done.
struct FalsifyResult {
  SweepOrders orders;                 ///< of every flight, in order
  std::vector<FlightRecord> records;  ///< of those
  std::vector<FalsifyTrial> trials;   ///< in order, one a point
  std::vector<size_t> failures;       ///< numbers of trials: distinct ones, in the order they were found
  size_t infeasible = 0;              ///< points that broke a constraint and were not flown
  bool stopped = false;               ///< by `fly`, before the search was done
};

/// Searches for points whose least robust check fails, with at most the budget's flights. Points are flown by
/// generations; a generation in which the last wanted failure is found is flown to its end, so that the result is the
/// same for any number of workers, and flights that an interrupted search left are found again. Two failures are
/// distinct where another check fails, or where their points are apart by a tenth of the ranges (root mean square).
/// Throws InputError when hardly any point keeps the constraints.
FalsifyResult falsify(const FalsifySearch& search, const FlyPoint& fly);

/// The flights' table, with generation, the least robust check and its robustness beside the parameters.
Table falsify_table(const FalsifySearch& search, const FalsifyResult& result);

}  // namespace hedgehop::sim
