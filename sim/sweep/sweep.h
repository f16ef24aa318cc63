#pragma once

#include <filesystem>
#include <vector>

#include "sim/batch/fly_orders.h"
#include "sim/batch/table.h"
#include "sim/sweep/sweep_file.h"

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
  void append(const SweepOrders& more);
};

/// Throws InputError with the faults of every point that the scenario refuses. Not for OptimizeDesign.
SweepOrders sweep_orders(const SweepConfig& sweep);

/// The orders of a shard.
SweepOrders part_of(const SweepOrders& all, Shard shard);

/// The flights' table with the point's number and the parameters' values as columns of their own.
/// @param before  further columns that stand before them.
Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records,
                  const std::vector<ExtraColumn>& before = {});

}  // namespace hedgehop::sim
