#include "sim/sweep/optimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/config/config_tree.h"

namespace hedgehop::sim {
namespace {

/// Returns the mean of a column over a point's flights. A flight that fails or lacks the figure counts as failure_cost.
double mean_cost(const OptimizeDesign& design, const std::vector<FlightRecord>& records) {
  const Table table = flight_table(records);
  const size_t column = column_index(table, design.minimize);
  double sum = 0.0;
  for (size_t i = 0; i < records.size(); ++i) {
    if (records[i].status == FlightRecord::Status::flown && column == table.columns.size()) {
      std::vector<std::string_view> names;
      for (const TableColumn& known : table.columns) names.push_back(known.name);
      throw InputError(
          fmt::format("'design.minimize': no column '{}'{}", design.minimize, suggestion(design.minimize, names)));
    }
    double cost = design.failure_cost;
    if (passed(records[i]) || unchecked(records[i])) {
      const Cell& cell = table.rows[i][column];
      if (const auto* number = std::get_if<double>(&cell)) cost = *number;
      if (const auto* whole = std::get_if<int64_t>(&cell)) cost = static_cast<double>(*whole);
    }
    sum += cost;
  }
  return sum / static_cast<double>(records.size());
}

/// State of the search in the unit cube, whose points are mapped to parameter values.
struct Search {
  const SweepConfig& sweep;
  const OptimizeDesign& design;
  const FlyPoint& fly;
  Optimum best{.values = {}, .cost = std::numeric_limits<double>::infinity(), .orders = {}, .records = {}};
  size_t points = 0;

  double cost(const std::vector<double>& coordinates) {
    std::vector<std::string> values;
    for (size_t i = 0; i < coordinates.size(); ++i) {
      values.push_back(parameter_value(sweep.parameters[i], std::clamp(coordinates[i], 0.0, 1.0)));
    }
    SweepOrders point;
    point.add(sweep, points, values);
    const std::optional<std::vector<FlightRecord>> records = fly(point.orders);
    if (!records) {
      best.stopped = true;
      throw StopMinimizing();
    }
    best.orders.add(sweep, points++, values);
    best.records.insert(best.records.end(), records->begin(), records->end());
    const double cost = mean_cost(design, *records);
    if (cost < best.cost) {
      best.cost = cost;
      best.values = values;
    }
    return cost;
  }
};

}  // namespace

Optimum optimize(const SweepConfig& sweep, const FlyPoint& fly) {
  const auto& design = std::get<OptimizeDesign>(sweep.design);
  Search search{.sweep = sweep, .design = design, .fly = fly};
  constexpr double kTolerance = 1e-4;  // of a range: finer differences of a gain are of no interest
  minimize({.method = design.method,
            .dimensions = sweep.parameters.size(),
            .max_points = static_cast<int>(design.evaluations),
            .tolerance = kTolerance},
           [&](const std::vector<double>& coordinates) { return search.cost(coordinates); });
  return std::move(search.best);
}

}  // namespace hedgehop::sim
