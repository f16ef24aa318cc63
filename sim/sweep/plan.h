#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/sweep/design.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim {

/// The flights of a sweep before they are flown. It stores 16 bytes per point; orders are made when they are needed.
/// Not for OptimizeDesign.
class SweepPlan {
 public:
  /// Loads the scenario of every point. A point that resolves to the same scenario as an earlier one is left out.
  /// Throws InputError with the faults of invalid points and of parameters without effect.
  explicit SweepPlan(const SweepConfig& sweep);

  size_t points() const { return points_.size(); }
  size_t flights() const { return points_.size() * seeds_.size(); }
  size_t seeds() const { return seeds_.size(); }
  /// Returns the orders of the points from `first` on, at most `count` points; of these the flights of the shard.
  SweepOrders orders(size_t first, size_t count, Shard shard = {}) const;

  /// One line for each kind of value that is not flown as written: rounded values and repeated points.
  const std::vector<std::string>& notices() const { return notices_; }
  /// Numbers of the points in the order of the design, with its repetitions.
  std::vector<std::string> numbers_of_design() const;
  size_t block() const { return design_.block(); }

 private:
  struct Point {
    uint64_t content;  ///< see content_of()
    uint32_t index;    ///< in the design
  };
  void require_effects() const;
  void note_repeated(size_t repeated, const std::vector<std::string>& examples);

  const SweepConfig& sweep_;
  DesignPoints design_;
  std::vector<uint64_t> seeds_;    ///< {0} if each scenario has its own
  std::vector<Point> points_;      ///< without repetitions, in the order of the design
  std::vector<uint64_t> content_;  ///< of all points of a design with blocks
  std::vector<std::string> notices_;
};

/// Returns a hash of a point's resolved scenario without the seed. Points with equal hashes fly equal flights.
uint64_t content_of(const SweepConfig& sweep, const std::vector<std::string>& values);

/// Returns the number of a point: a letter and eleven hexadecimal digits of its content, so that no program takes it
/// for a number.
std::string point_number(uint64_t content);

/// Returns the orders of one point, one per seed. @param label  of the point, in ids and groups; empty for its number.
/// Throws InputError if the scenario is invalid with the point's values.
std::vector<Order> point_orders(const SweepConfig& sweep, const std::vector<std::string>& values,
                                std::string label = "");

}  // namespace hedgehop::sim
