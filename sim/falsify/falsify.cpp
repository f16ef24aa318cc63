#include "sim/falsify/falsify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/batch/seeds.h"
#include "sim/falsify/box_constraints.h"
#include "sim/falsify/cma_es.h"
#include "sim/falsify/competition_score.h"
#include "sim/flight/flight.h"
#include "sim/libm/random.h"
#include "sim/sweep/optimize.h"
#include "sim/sweep/plan.h"
#include "sim/sweep/sampling.h"

namespace hedgehop::sim {
namespace {

using Coordinates = std::vector<double>;

constexpr double kInfeasibleCost = kMaxClearanceM;  // above any robustness
constexpr int kRedraws = 20;                        // of an infeasible point of a generation
constexpr double kMinDistance = 0.1;                // share of the ranges: failures closer to each other count as one

/// Thrown to end a search: interrupted, budget exhausted, or all required failures found.
struct SearchEnds {};

class Search {
 public:
  Search(const FalsifySearch& search, const FlyPoint& fly)
      : search_(search), design_(search.config.design), fly_(fly), random_(design_.seed) {}

  FalsifyResult run() {
    try {
      switch (design_.method) {
        case FalsifyDesign::Method::cma_es:
          evolve();
          break;
        case FalsifyDesign::Method::direct:
          divide();
          break;
        case FalsifyDesign::Method::random:
          while (true) fly_generation(random_points(population()), 0);
      }
    } catch (const SearchEnds&) {
    }
    return std::move(result_);
  }

 private:
  size_t dimensions() const { return search_.sweep.parameters.size(); }
  size_t population() const { return CmaEsParameters(static_cast<Eigen::Index>(dimensions())).population; }
  size_t seeds() const { return search_.sweep.seeds ? parse_seeds(*search_.sweep.seeds).size() : 1; }
  size_t points_left() const { return (static_cast<size_t>(design_.budget) - result_.records.size()) / seeds(); }

  std::vector<std::string> values_at(const Coordinates& coordinates) const {
    std::vector<std::string> values;
    for (size_t i = 0; i < coordinates.size(); ++i) {
      values.push_back(parameter_value(search_.sweep.parameters[i], coordinates[i]));
    }
    return values;
  }
  double violation_at(const Coordinates& coordinates) const {
    return search_.config.constraints.empty() ? 0.0 : violation(search_, boxes_at(search_, values_at(coordinates)));
  }

  Coordinates random_point() {
    Coordinates point(dimensions());
    constexpr int kMaxDraws = 20'000;
    for (int draw = 0; draw < kMaxDraws; ++draw) {
      for (double& coordinate : point) coordinate = uniform(random_);
      if (violation_at(point) == 0.0) return point;
      ++result_.infeasible;
    }
    throw InputError(fmt::format("0 of {} random points satisfy the constraints", kMaxDraws));
  }
  std::vector<Coordinates> random_points(size_t count) {
    std::vector<Coordinates> points;
    for (size_t i = 0; i < count; ++i) points.push_back(random_point());
    return points;
  }

  /// Flies feasible points, as many as the budget allows. Throws SearchEnds if the search is over.
  void fly_generation(std::vector<Coordinates> points, size_t generation) {
    points.resize(std::min(points.size(), points_left()));
    if (points.empty()) throw SearchEnds{};
    SweepOrders orders;
    for (const Coordinates& point : points)
      add_point(result_.trials.size() + orders.orders.size() / seeds(), point, orders);
    const auto records = fly_(orders.orders);
    if (!records) {
      result_.stopped = true;
      throw SearchEnds{};
    }
    for (size_t i = 0; i < points.size(); ++i) {
      judge({.coordinates = points[i], .values = orders.values[i * seeds()], .generation = generation}, *records,
            i * seeds());
    }
    result_.orders.append(orders);
    result_.records.insert(result_.records.end(), records->begin(), records->end());
    if (has_enough() || points_left() == 0) throw SearchEnds{};
  }
  bool has_enough() const { return result_.failures.size() >= static_cast<size_t>(design_.failures); }

  /// Adds the orders of a point. If the scenario refuses the point, the orders carry a fault and are not flown.
  void add_point(size_t number, const Coordinates& point, SweepOrders& orders) {
    const std::vector<std::string> values = values_at(point);
    const std::string label = fmt::format("{:06}", number);
    try {
      for (Order& order : point_orders(search_.sweep, values, label)) {
        orders.add(std::move(order), values, std::to_string(number));
      }
    } catch (const InputError& error) {
      for (size_t i = 0; i < seeds(); ++i) {
        Order order{.id = fmt::format("flights/{}-{}", label, i), .scenario = search_.sweep.scenario};
        order.fault = error.errors().front();
        orders.add(std::move(order), values, std::to_string(number));
      }
    }
  }

  /// Adds a flown point. @param first  index of its first flight in `records`.
  void judge(FalsifyTrial trial, const std::vector<FlightRecord>& records, size_t first) {
    trial.weakest.robustness = kInfeasibleCost;
    trial.record = result_.records.size() + first;
    for (size_t k = first; k < first + seeds(); ++k) {
      const auto weakest = objective(search_, records[k]);
      if (!weakest || (trial.flown && weakest->robustness >= trial.weakest.robustness)) continue;
      trial.flown = true;
      trial.weakest = *weakest;
      trial.record = result_.records.size() + k;
    }
    if (trial.fails() && !has_enough() && is_new(trial)) result_.failures.push_back(result_.trials.size());
    result_.trials.push_back(std::move(trial));
  }

  bool is_new(const FalsifyTrial& trial) const {
    return std::ranges::none_of(result_.failures, [&](size_t failure) {
      const FalsifyTrial& known = result_.trials[failure];
      return known.weakest.name == trial.weakest.name && distance(known.coordinates, trial.coordinates) < kMinDistance;
    });
  }
  static double distance(const Coordinates& a, const Coordinates& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
  }

  /// Flies random points first, then descends from each of them, the best first.
  void evolve() {
    constexpr size_t kMaxStarts = 20;
    const size_t draws = std::min(kMaxStarts, std::max<size_t>(1, points_left() / 5));
    for (size_t flown = 0; flown < draws; flown = result_.trials.size()) {
      fly_generation(random_points(std::min(population(), draws - flown)), 0);
    }
    std::vector<FalsifyTrial> starts = result_.trials;
    std::ranges::stable_sort(starts, {}, [](const FalsifyTrial& trial) { return trial.weakest.robustness; });
    for (const FalsifyTrial& start : starts) descend(start.coordinates);
    while (true) {
      const Coordinates start = random_point();
      fly_generation({start}, 0);
      descend(start);
    }
  }

  /// Runs one evolution until it finds a failure or stops improving.
  void descend(const Coordinates& start) {
    constexpr double kStep = 0.15;  // of the ranges
    constexpr int kPatience = 6;    // generations
    constexpr double kImprovement = 1e-3;
    CmaEs evolution(Eigen::VectorXd::Map(start.data(), static_cast<Eigen::Index>(start.size())), kStep, random_());
    double best = kInfeasibleCost;
    for (int idle = 0; idle < kPatience; ++idle) {
      std::vector<CostedPoint> generation;
      std::vector<Coordinates> feasible;
      std::vector<size_t> places;
      for (size_t i = 0; i < evolution.population(); ++i) {
        Coordinates point = drawn(evolution);
        const double broken = violation_at(point);
        generation.push_back(
            {Eigen::VectorXd::Map(point.data(), static_cast<Eigen::Index>(point.size())), kInfeasibleCost + broken});
        if (broken > 0.0) {
          ++result_.infeasible;
          continue;
        }
        places.push_back(i);
        feasible.push_back(std::move(point));
      }
      const size_t first = result_.trials.size(), failures = result_.failures.size();
      if (!feasible.empty()) fly_generation(feasible, ++generations_);
      double min_cost = kInfeasibleCost;
      for (size_t i = 0; i < places.size(); ++i) {
        min_cost = std::min(min_cost, generation[places[i]].cost = result_.trials[first + i].weakest.robustness);
      }
      if (result_.failures.size() > failures) return;  // the next one is searched from another start
      if (min_cost < best - kImprovement) idle = -1;
      best = std::min(best, min_cost);
      evolution.adapt(std::move(generation));
    }
  }

  /// Returns a point of the evolution inside the ranges, feasible if kRedraws draws yield such a point.
  Coordinates drawn(CmaEs& evolution) {
    Coordinates point(dimensions());
    for (int draw = 0; draw < kRedraws; ++draw) {
      const Eigen::VectorXd x = evolution.draw();
      point.assign(x.begin(), x.end());
      const bool inside = std::ranges::all_of(point, [](double c) { return c >= 0.0 && c <= 1.0; });
      if (!inside) continue;
      if (violation_at(point) == 0.0) return point;
      if (draw + 1 < kRedraws) ++result_.infeasible;  // the caller counts the last one
    }
    for (double& coordinate : point) coordinate = std::clamp(coordinate, 0.0, 1.0);
    return point;
  }

  /// Runs DIRECT, which flies one point at a time.
  void divide() {
    constexpr int kPointsPerFlight = 20;  // maximum; all but one of them violate the constraints
    minimize({.method = OptimizeDesign::Method::direct,
              .dimensions = dimensions(),
              .max_points = kPointsPerFlight * static_cast<int>(design_.budget)},
             [&](const Coordinates& point) { return cost(point); });
  }
  double cost(const Coordinates& point) {
    const double broken = violation_at(point);
    if (broken > 0.0) {
      ++result_.infeasible;
      return kInfeasibleCost + broken;
    }
    fly_generation({point}, result_.trials.size());
    return result_.trials.back().weakest.robustness;
  }

  const FalsifySearch& search_;
  const FalsifyDesign& design_;
  const FlyPoint& fly_;
  Random random_;
  size_t generations_ = 0;
  FalsifyResult result_;
};

}  // namespace

FalsifyResult falsify(const FalsifySearch& search, const FlyPoint& fly) { return Search(search, fly).run(); }

Table falsify_table(const FalsifySearch& search, const FalsifyResult& result) {
  std::vector<double> generations, robustness;
  std::vector<std::string> weakest_checks;
  const size_t seeds = result.trials.empty() ? 1 : result.records.size() / result.trials.size();
  for (size_t i = 0; i < result.records.size(); ++i) {
    const auto weakest = objective(search, result.records[i]);
    generations.push_back(static_cast<double>(result.trials[i / seeds].generation));
    weakest_checks.push_back(weakest ? weakest->name : "");
    robustness.push_back(weakest ? weakest->robustness : std::numeric_limits<double>::quiet_NaN());
  }
  const std::vector<Table::Column> before = {{.name = "generation", .values = std::move(generations), .whole = true},
                                             {.name = "weakest", .values = std::move(weakest_checks)},
                                             {.name = "robustness", .values = std::move(robustness)}};
  return sweep_table(search.sweep, result.orders, result.records, before);
}

}  // namespace hedgehop::sim
