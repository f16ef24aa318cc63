#include "sim/campaign/optimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <nlopt.hpp>

#include "sim/scenario/tree.h"

namespace hedgehop::sim {
namespace {

nlopt::algorithm algorithm(OptimizeDesign::Method method) {
  switch (method) {
    case OptimizeDesign::Method::subplex:
      return nlopt::LN_SBPLX;
    case OptimizeDesign::Method::nelder_mead:
      return nlopt::LN_NELDERMEAD;
    case OptimizeDesign::Method::bobyqa:
      return nlopt::LN_BOBYQA;
    case OptimizeDesign::Method::direct:
      return nlopt::GN_DIRECT_L;
  }
  return nlopt::LN_SBPLX;
}

/// Mean of a column over a point's flights; a flight that does not pass or lacks a number there counts its cost.
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

/// The search's own view: it moves in the unit cube, whose points become values.
struct Search {
  const SweepConfig& sweep;
  const OptimizeDesign& design;
  const FlyPoint& fly;
  Optimum best{.values = {}, .cost = std::numeric_limits<double>::infinity(), .orders = {}, .records = {}};
  size_t points = 0;
  std::exception_ptr fault = {};  ///< nlopt passes on only exceptions of its own

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
      throw nlopt::forced_stop();
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

  static double objective(const std::vector<double>& coordinates, std::vector<double>&, void* data) {
    auto& search = *static_cast<Search*>(data);
    try {
      return search.cost(coordinates);
    } catch (const nlopt::forced_stop&) {
      throw;
    } catch (...) {
      search.fault = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
};

}  // namespace

Optimum optimize(const SweepConfig& sweep, const FlyPoint& fly) {
  const auto& design = std::get<OptimizeDesign>(sweep.design);
  const size_t dimensions = sweep.parameters.size();
  Search search{.sweep = sweep, .design = design, .fly = fly};
  nlopt::opt optimizer(algorithm(design.method), static_cast<unsigned>(dimensions));
  optimizer.set_lower_bounds(0.0);
  optimizer.set_upper_bounds(1.0);
  optimizer.set_maxeval(static_cast<int>(design.evaluations));
  constexpr double kTolerance = 1e-4;  // of a range: finer differences of a gain are of no interest
  optimizer.set_xtol_abs(kTolerance);
  constexpr double kFirstStep = 0.25;  // of a range
  optimizer.set_initial_step(kFirstStep);
  optimizer.set_min_objective(Search::objective, &search);
  std::vector<double> x(dimensions, 0.5);
  double cost = 0.0;
  try {
    optimizer.optimize(x, cost);
  } catch (const nlopt::roundoff_limited&) {  // as good as it gets
  } catch (const nlopt::forced_stop&) {
    if (search.fault) std::rethrow_exception(search.fault);
  }
  return std::move(search.best);
}

}  // namespace hedgehop::sim
