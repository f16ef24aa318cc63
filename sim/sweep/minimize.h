#pragma once

#include <functional>
#include <vector>

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

}  // namespace hedgehop::sim
