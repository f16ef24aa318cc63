#include "sim/sweep/optimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/config/config_tree.h"
#include "sim/sweep/design.h"
#include "sim/sweep/plan.h"

namespace hedgehop::sim {
namespace {

/// Returns the fault of the minimized column if it can be no column of any flight: read_sweep() accepts all names of a
/// module's metrics. Metrics of the judge may be absent.
std::string absence_fault(const OptimizeDesign& design, const std::vector<FlightRecord>& records) {
  const Table table = flight_table(records);
  const bool any_flown =
      std::ranges::any_of(records, [](const FlightRecord& record) { return record.result.has_value(); });
  if (!any_flown || table.has(design.minimize)) return "";
  if (!design.minimize.starts_with("metric.module.") && !design.minimize.starts_with("time.")) return "";
  const std::vector<std::string_view> names(table.names().begin(), table.names().end());
  return fmt::format("'design.minimize': no column '{}'{}", design.minimize, suggestion(design.minimize, names));
}

/// Returns the mean of a column over a point's flights. A flight that fails or lacks the figure counts as failure_cost.
double mean_cost(const OptimizeDesign& design, const std::vector<FlightRecord>& records) {
  const Table table = flight_table(records);
  const auto* const numbers =
      table.has(design.minimize) ? std::get_if<std::vector<double>>(&table.column(design.minimize).values) : nullptr;
  double sum = 0.0;
  for (size_t i = 0; i < records.size(); ++i) {
    const bool counts = numbers && holds(verdict_of(records[i])) && !std::isnan((*numbers)[i]);
    sum += counts ? (*numbers)[i] : design.failure_cost;
  }
  return sum / static_cast<double>(records.size());
}

/// State of the search in the unit cube, whose points are mapped to parameter values.
struct Search {
  const SweepConfig& sweep;
  const OptimizeDesign& design;
  const FlyPoint& fly;
  Optimum best{.values = {}, .cost = std::numeric_limits<double>::infinity(), .orders = {}, .records = {}};
  std::map<std::string, double> known;  ///< costs of flown points by number

  double cost(const std::vector<double>& coordinates) {
    std::vector<std::string> values;
    for (size_t i = 0; i < coordinates.size(); ++i) {
      values.push_back(design_value(sweep.parameters[i], std::clamp(coordinates[i], 0.0, 1.0)));
    }
    const std::string number = point_number(content_of(sweep, values));
    if (const auto flown = known.find(number); flown != known.end()) return flown->second;
    SweepOrders point;
    for (Order& order : point_orders(sweep, values)) point.add(std::move(order), values, number);
    const std::optional<std::vector<FlightRecord>> records = fly(point.orders);
    if (!records) {
      best.stopped = true;
      throw StopMinimizing();
    }
    best.orders.append(point);
    best.records.insert(best.records.end(), records->begin(), records->end());
    if (best.fault = known.empty() ? absence_fault(design, *records) : ""; !best.fault.empty()) {
      best.stopped = true;
      throw StopMinimizing();
    }
    const double cost = known[number] = mean_cost(design, *records);
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
  const MinimizeOptions options{.method = design.method,
                                .dimensions = sweep.parameters.size(),
                                .max_points = static_cast<int>(design.evaluations),
                                .tolerance = kTolerance};
  search.best.early_end =
      minimize(options, [&](const std::vector<double>& coordinates) { return search.cost(coordinates); });
  if (search.best.early_end.empty() && search.known.size() < static_cast<size_t>(design.evaluations))
    search.best.early_end = "the other evaluations repeat a point";
  return std::move(search.best);
}

}  // namespace hedgehop::sim
