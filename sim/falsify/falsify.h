#pragma once

#include <string>
#include <vector>

#include "sim/falsify/falsify_file.h"
#include "sim/falsify/weakest_check.h"
#include "sim/sweep/optimize.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim {

/// A flown point.
struct FalsifyTrial {
  std::vector<double> coordinates;  ///< in the unit cube, one per parameter of the search's sweep
  std::vector<std::string> values;
  size_t generation = 0;  ///< 0 for random points
  bool flown = false;     ///< with at least one seed; else `weakest` is a clear pass without a name
  WeakestCheck weakest;   ///< over the seeds that were flown
  size_t record = 0;      ///< number of the flight of the weakest check

  bool fails() const { return weakest.robustness < 0.0; }
};

/// The flights and failures of a search.
struct FalsifyResult {
  SweepOrders orders;                 ///< of every flight, in order
  std::vector<FlightRecord> records;  ///< of the orders
  std::vector<FalsifyTrial> trials;   ///< in order, one per point
  std::vector<size_t> failures;       ///< numbers of distinct failing trials, in order of discovery
  size_t infeasible = 0;              ///< points that violated a constraint and were not flown
  bool stopped = false;               ///< by `fly`, before the search ended
};

/// Searches for points whose weakest check fails, within the budget of flights. Points are flown in generations. A
/// generation is always completed, even if it contains the last required failure. The result is therefore the same for
/// any number of workers, and a resumed search reuses the flights of the interrupted one. Two failures are distinct if
/// different checks fail, or if the distance of their points is at least a tenth of the ranges (root mean square).
/// Throws InputError if almost no point satisfies the constraints.
FalsifyResult falsify(const FalsifySearch& search, const FlyPoint& fly);

/// Returns the table of flights with columns for the generation, the weakest check, its robustness and the parameters.
Table falsify_table(const FalsifySearch& search, const FalsifyResult& result);

}  // namespace hedgehop::sim
