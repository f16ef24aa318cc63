#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim {

/// The points of a design. The values of a point are made when they are needed, so that a million points need little
/// memory. Not for OptimizeDesign, which searches.
class DesignPoints {
 public:
  /// @param sweep  of read_sweep(), which limits the points to kMaxSweepPoints; must outlive this object.
  explicit DesignPoints(const SweepConfig& sweep);

  size_t size() const { return size_; }
  /// Returns the values of the parameters, in their order. @param index  < size().
  std::vector<std::string> values(size_t index) const;

  /// Points of a block of a Sobol design with indices: A, B, and A with one column of B for each parameter. 0 for
  /// other designs.
  size_t block() const { return block_; }

 private:
  const SweepConfig& sweep_;
  size_t size_ = 0, block_ = 0;
  std::vector<double> coordinates_;  ///< of random designs, point by point
};

/// Returns the number of points of a design without making them; kMaxSweepPoints + 1 for any larger number.
size_t count_points(const SweepConfig& sweep);

/// Returns a parameter's value at a coordinate in [0, 1] as a decimal without noise: up to 12 significant figures, 6 on
/// a log scale.
std::string design_value(const SweepParameter& parameter, double coordinate);

/// Returns one line for each parameter with values that are rounded to whole numbers, "" for the others.
std::vector<std::string> rounding_notices(const SweepConfig& sweep);

}  // namespace hedgehop::sim
