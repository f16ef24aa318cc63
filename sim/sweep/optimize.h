#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/sweep.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim {

/// Thrown by a function to end its minimization.
struct StopMinimizing {};

struct MinimizeOptions {
  OptimizeDesign::Method method = OptimizeDesign::Method::subplex;
  size_t dimensions = 1;
  int most_points = 100;
  double tolerance = 0.0;  ///< of a coordinate; 0: no end but the number of points
};

/// Minimizes a function of points in the unit cube, from its middle, by NLopt. Equal functions see equal points in the
/// same order. What the function throws comes through. Throws InputError in a build without NLopt.
void minimize(const MinimizeOptions& options, const std::function<double(const std::vector<double>&)>& cost);

/// Flies the orders of one point; nothing when the search is to stop. An earlier result of the same order is reused.
using FlyPoint = std::function<std::optional<std::vector<FlightRecord>>(const std::vector<Order>& orders)>;

/// The result of an optimization.
struct Optimum {
  std::vector<std::string> values;
  double cost = 0.0;
  SweepOrders orders;                 ///< of every point flown, in order
  std::vector<FlightRecord> records;  ///< of those
  bool stopped = false;               ///< by `fly`, before the search was done
};

/// Minimizes the mean of the design's column over the sweep's seeds, the same at every point. Equal sweeps fly equal
/// points in the same order, so that flights left by an interrupted search are found again.
/// What `fly` throws comes through, and InputError when the table of the first point lacks the design's column.
Optimum optimize(const SweepConfig& sweep, const FlyPoint& fly);

}  // namespace hedgehop::sim
