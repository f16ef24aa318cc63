#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "sim/campaign/fly_orders.h"
#include "sim/campaign/sweep_file.h"
#include "sim/campaign/table.h"

namespace hedgehop::sim {

/// One part of a sweep, for several machines: every `of`-th flight, beginning with number `index`.
struct Shard {
  size_t index = 1, of = 1;  ///< 1 <= index <= of
};

/// "2/8". Throws InputError for anything else.
Shard parse_shard(const std::string& text);

/// A sweep's flights, all of them.
struct SweepOrders {
  std::vector<Order> orders;
  std::vector<std::vector<std::string>> values;  ///< of the parameters, one list an order
  std::vector<size_t> points;                    ///< number of the point, one an order

  void add(const SweepConfig& sweep, size_t point, const std::vector<std::string>& point_values);
};

/// Throws InputError with the faults of every point that the scenario refuses. Not for OptimizeDesign.
SweepOrders sweep_orders(const SweepConfig& sweep);

/// The orders of a shard.
SweepOrders part_of(const SweepOrders& all, Shard shard);

/// The flights' table with the point's number and the parameters' values as columns of their own.
Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records);

/// Flies the orders of one point; nothing when the search is to stop. A former result of the very same order stands.
using FlyPoint = std::function<std::optional<std::vector<FlightRecord>>(const std::vector<Order>& orders)>;

/// What an optimizer has found.
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
