#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/sweep.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim {

/// Thrown by a cost function to end its minimization.
struct StopMinimizing {};

struct MinimizeOptions {
  OptimizeDesign::Method method = OptimizeDesign::Method::subplex;
  size_t dimensions = 1;
  int max_points = 100;
  double tolerance = 0.0;  ///< of a coordinate; 0: only max_points ends the search
};

/// Minimizes a function on the unit cube with NLopt, starting at its center. Equal functions are evaluated at equal
/// points in the same order. Exceptions of the function are passed on. Throws InputError in a build without NLopt.
/// @return why the search ended before `max_points`; "" if it did not.
std::string minimize(const MinimizeOptions& options, const std::function<double(const std::vector<double>&)>& cost);

/// Flies the orders of one point; returns nullopt to stop the search. An earlier result of the same order is reused.
using FlyPoint = std::function<std::optional<std::vector<FlightRecord>>(const std::vector<Order>& orders)>;

/// The result of an optimization.
struct Optimum {
  std::vector<std::string> values;
  double cost = 0.0;
  SweepOrders orders;                 ///< of every flown point, in order
  std::vector<FlightRecord> records;  ///< of the orders
  bool stopped = false;               ///< by `fly` or by a fault, before the search ended
  std::string fault = {};             ///< the column of a module's metric that no flight of the first point has
  std::string early_end = {};         ///< why the search flew fewer points than `evaluations`; "" if it did not
};

/// Minimizes the mean of the design's column over the sweep's seeds, which are the same at every point. Equal sweeps
/// fly equal points in the same order, so a resumed search reuses the flights of the interrupted one. Exceptions of
/// `fly` are passed on.
Optimum optimize(const SweepConfig& sweep, const FlyPoint& fly);

}  // namespace hedgehop::sim
