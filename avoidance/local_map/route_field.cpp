#include "avoidance/local_map/route_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr int kStraight = 10;          // cost of a step to a neighbor, in tenths of a cell
constexpr double kSideM = 0.8;         // additional distance from obstacles that a route prefers
constexpr int kClosePrice = 3;         // factor on the cost without the additional distance
constexpr int kNarrowPrice = 5;        // factor on the cost below the preferred distance
constexpr double kKeptPrice = 8.0;     // the same for long detours
constexpr double kGivenUpPrice = 2.5;  // the same for short detours
constexpr double kDeepPrice = 8.0;     // additional factor at the minimum distance
static_assert(kStraight * RouteField::kUnknownPrice * (kKeptPrice + kDeepPrice) <= 255, "a price has 8 bits");

struct Step {
  int row, col;
  double length;
};
constexpr Step kSteps[8] = {{-1, 0, 1.0},         {1, 0, 1.0},         {0, -1, 1.0},        {0, 1, 1.0},
                            {-1, -1, 1.41421356}, {-1, 1, 1.41421356}, {1, -1, 1.41421356}, {1, 1, 1.41421356}};

/// Costs of a straight and of a diagonal step by the sum of the prices of both cells.
using StepCosts = std::array<std::array<int, 2 * 255 + 1>, 2>;

StepCosts step_costs() {
  StepCosts costs;
  for (size_t sum = 0; sum < costs[0].size(); ++sum) {
    const double mean = 0.5 * static_cast<double>(sum);
    for (const Step& step : {kSteps[0], kSteps[4]}) {
      costs[step.length > 1.0][sum] = std::max(1, static_cast<int>(std::lround(mean * step.length)));
    }
  }
  return costs;
}

constexpr double kSquareM = 3.0, kHighM = 1.2;
constexpr int kSquares = 4;             // number of squares around that of the vehicle
constexpr double kBothWaysPrice = 3.5;  // cost of a meter of climb and descent, in meters of path
constexpr size_t kMaxSquares = 20'000;  // maximum number of squares; above it all are deleted

/// Returns the factor on the cost at a distance below the preferred one.
double narrow_price(const RouteClearance& wanted, double away_m) {
  if (wanted.detours == RouteClearance::Detours::short_ones) return kGivenUpPrice;
  if (wanted.detours == RouteClearance::Detours::usual) return kNarrowPrice;
  return kKeptPrice + kDeepPrice * (wanted.preferred_m - away_m) / (wanted.preferred_m - wanted.least_m);
}

}  // namespace

void RouteField::build(const LevelSlice& slice, const RouteClearance& route_clearance, const Eigen::Vector2d& goal_W,
                       const std::function<double(const Eigen::Vector2d&)>& beyond_m) {
  slice_ = &slice;
  const int n = slice.side();
  price_.assign(static_cast<size_t>(n * n), 0);
  cost_.assign(static_cast<size_t>(n * n), kNever);
  for (int row = 0; row < n; ++row) {
    for (int col = 0; col < n; ++col) {
      const double away_m = slice.to_occupied_m(row, col);
      if (away_m < route_clearance.least_m) continue;
      const double side = std::max(0.0, 1.0 - (away_m - route_clearance.preferred_m) / kSideM);
      double price = slice.at(row, col) == LevelSlice::State::free ? 1.0 : kUnknownPrice;
      price *= side > 1.0 ? narrow_price(route_clearance, away_m) : 1.0 + (kClosePrice - 1) * side;
      price_[static_cast<size_t>(row * n + col)] = static_cast<uint8_t>(std::lround(kStraight * price));
    }
  }
  seed(goal_W, beyond_m);
  spread();
}

void RouteField::push(int cell, int cost) {
  if (cost >= cost_[static_cast<size_t>(cell)]) return;
  cost_[static_cast<size_t>(cell)] = cost;
  const auto bucket = static_cast<size_t>(cost);
  if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
  buckets_[bucket].push_back(cell);
  ++waiting_;
}

/// Seeds the cell of the goal or the nearest cell that is not blocked; for a goal outside, all cells at the edge.
void RouteField::seed(const Eigen::Vector2d& goal_W, const std::function<double(const Eigen::Vector2d&)>& beyond_m) {
  for (auto& bucket : buckets_) bucket.clear();
  waiting_ = 0;
  beyond_m_ = 0.0;
  const int n = slice_->side();
  const Eigen::Vector2i goal = slice_->cell(goal_W);
  const double tenths_per_m = kStraight / slice_->cell_m();
  if (slice_->contains(goal.x(), goal.y())) {
    int best = -1;
    double best_m = std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < n * n; ++cell) {
      if (price_[static_cast<size_t>(cell)] == 0) continue;
      const double away_m = (slice_->center(cell / n, cell % n) - goal_W).norm();
      if (away_m >= best_m) continue;
      best = cell;
      best_m = away_m;
    }
    if (best >= 0) push(best, 0);
    return;
  }
  double least_m = std::numeric_limits<double>::infinity();
  std::vector<std::pair<int, double>> edge;
  for (int i = 0; i < n; ++i) {
    for (const int cell : {i, (n - 1) * n + i, i * n, i * n + n - 1}) {
      if (price_[static_cast<size_t>(cell)] == 0) continue;
      edge.emplace_back(cell, beyond_m(slice_->center(cell / n, cell % n)));
      least_m = std::min(least_m, edge.back().second);
    }
  }
  // Distances count from the nearest edge, which keeps the number of buckets small; to_goal_m() adds the rest.
  beyond_m_ = edge.empty() ? 0.0 : least_m;
  for (const auto& [cell, away_m] : edge) {
    if (std::isfinite(away_m)) push(cell, static_cast<int>(std::lround(tenths_per_m * (away_m - least_m))));
  }
}

/// Returns whether a diagonal step touches a blocked cell. Routes avoid such steps because plans cannot follow them.
bool RouteField::cuts_corner(int row, int col, int rows, int cols) const {
  if (rows == 0 || cols == 0) return false;
  const int n = slice_->side();
  return price_[static_cast<size_t>((row + rows) * n + col)] == 0 ||
         price_[static_cast<size_t>(row * n + col + cols)] == 0;
}

/// Dijkstra's search with one bucket for each cost.
void RouteField::spread() {
  static const StepCosts kCosts = step_costs();
  const int n = slice_->side();
  for (size_t bucket = 0; waiting_ > 0 && bucket < buckets_.size(); ++bucket) {
    for (size_t i = 0; i < buckets_[bucket].size(); ++i) {
      const int cell = buckets_[bucket][i];
      --waiting_;
      if (cost_[static_cast<size_t>(cell)] != static_cast<int>(bucket)) continue;
      const int row = cell / n, col = cell % n;
      const bool inside = row > 0 && col > 0 && row < n - 1 && col < n - 1;
      for (const Step& step : kSteps) {
        if (!inside && !slice_->contains(row + step.row, col + step.col)) continue;
        const int next = cell + step.row * n + step.col;
        if (cost_[static_cast<size_t>(next)] <= static_cast<int>(bucket)) continue;
        const int price = price_[static_cast<size_t>(next)];
        if (price == 0 || cuts_corner(row, col, step.row, step.col)) continue;
        const auto sum = static_cast<size_t>(price + price_[static_cast<size_t>(cell)]);
        push(next, static_cast<int>(bucket) + kCosts[step.length > 1.0][sum]);
      }
    }
  }
}

std::optional<double> RouteField::to_goal_m(const Eigen::Vector2d& p_W) const {
  const Eigen::Vector2i here = slice_->cell(p_W);
  double best = std::numeric_limits<double>::infinity();
  for (int row = here.x() - 1; row <= here.x() + 1; ++row) {
    for (int col = here.y() - 1; col <= here.y() + 1; ++col) {
      if (!slice_->contains(row, col) || cost(row, col) >= kNever) continue;
      const double away = (slice_->center(row, col) - p_W).norm() / slice_->cell_m();
      best = std::min(best, cost(row, col) + away * price_[static_cast<size_t>(row * slice_->side() + col)]);
    }
  }
  if (!std::isfinite(best)) return back_to_route_m(p_W);
  return beyond_m_ + best * slice_->cell_m() / kStraight;
}

/// Returns the distance to the goal from a cell outside all routes: the way back to a route, through cells that are not
/// occupied. Its cost is high, because it may lead through a gap that is too narrow.
std::optional<double> RouteField::back_to_route_m(const Eigen::Vector2d& p_W) const {
  constexpr int kReach = 8, kSide = 2 * kReach + 1;
  constexpr double kDear = 10.0;
  const Eigen::Vector2i from = slice_->cell(p_W);
  std::array<bool, kSide * kSide> visited{};
  std::vector<Eigen::Vector2i> open = {from};
  visited[kReach * kSide + kReach] = true;
  for (size_t i = 0; i < open.size(); ++i) {
    const Eigen::Vector2i at = open[i], off = at - from + Eigen::Vector2i::Constant(kReach);
    if (!slice_->contains(at.x(), at.y())) continue;
    if (cost(at.x(), at.y()) < kNever) {
      const double away_m = (slice_->center(at.x(), at.y()) - p_W).norm();
      return beyond_m_ + cost(at.x(), at.y()) * slice_->cell_m() / kStraight + kDear * away_m;
    }
    if (i > 0 && slice_->at(at.x(), at.y()) == LevelSlice::State::occupied) continue;
    for (const Step& step : kSteps) {
      const Eigen::Vector2i next = off + Eigen::Vector2i(step.row, step.col);
      if (next.minCoeff() < 0 || next.maxCoeff() >= kSide) continue;
      bool& seen = visited[static_cast<size_t>(next.x() * kSide + next.y())];
      if (seen) continue;
      seen = true;
      open.push_back(at + Eigen::Vector2i(step.row, step.col));
    }
  }
  return std::nullopt;
}

std::vector<Eigen::Vector2d> RouteField::route_W(const Eigen::Vector2d& p_W, double length_m) const {
  std::vector<Eigen::Vector2d> route = {p_W};
  Eigen::Vector2i cell = slice_->cell(p_W);
  if (!slice_->contains(cell.x(), cell.y())) return route;
  for (double flown_m = 0.0; flown_m < length_m;) {
    Eigen::Vector2i best = cell;
    for (const Step& step : kSteps) {
      const Eigen::Vector2i next = cell + Eigen::Vector2i(step.row, step.col);
      if (!slice_->contains(next.x(), next.y()) || cuts_corner(cell.x(), cell.y(), step.row, step.col)) continue;
      if (cost(next.x(), next.y()) < cost(best.x(), best.y())) best = next;
    }
    if (best == cell) break;
    flown_m += slice_->cell_m() * (best - cell).cast<double>().norm();
    cell = best;
    route.push_back(slice_->center(cell.x(), cell.y()));
  }
  return route;
}

double RouteField::nearest_m(const Eigen::Vector2d& p_W, double length_m) const {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& at_W : route_W(p_W, length_m)) least_m = std::min(least_m, slice_->to_occupied_m(at_W));
  return least_m;
}

LearnedDistances::Square LearnedDistances::square(const Eigen::Vector2d& p_W) {
  const Eigen::Vector2i at = (p_W / kSquareM).array().floor().cast<int>();
  return {at.x(), at.y()};
}

void LearnedDistances::learn(const RouteField& route, const LevelSlice& slice, const Eigen::Vector3d& p_W,
                             const Eigen::Vector3d& goal_W) {
  constexpr double kSameM = 0.5;
  if (!goal_W_ || (goal_W - *goal_W_).norm() > kSameM || distances_m_.size() > kMaxSquares) distances_m_.clear();
  goal_W_ = goal_W;
  const Eigen::Vector2i here = (p_W.head<2>() / kSquareM).array().floor().cast<int>();
  for (int row = here.x() - kSquares; row <= here.x() + kSquares; ++row) {
    for (int col = here.y() - kSquares; col <= here.y() + kSquares; ++col) {
      const Eigen::Vector2d middle_W = kSquareM * Eigen::Vector2d(row + 0.5, col + 0.5);
      const Eigen::Vector2i cell = slice.cell(middle_W);
      if (!slice.contains(cell.x(), cell.y()) || slice.at(cell.x(), cell.y()) != LevelSlice::State::free) continue;
      const std::optional<double> found_m = route.to_goal_m(middle_W);
      if (!found_m) continue;
      double& known_m = distances_m_[square(middle_W)][static_cast<int>(std::lround(p_W.z() / kHighM))];
      known_m = std::max(known_m, *found_m);
    }
  }
}

double LearnedDistances::at_least_m(const Eigen::Vector2d& p_W, double z_W) const {
  const auto known = distances_m_.find(square(p_W));
  double most_m = 0.0;
  if (known == distances_m_.end()) return most_m;
  for (const auto& [level, found_m] : known->second) {
    most_m = std::max(most_m, found_m - kBothWaysPrice * std::abs(kHighM * level - z_W));
  }
  return most_m;
}

}  // namespace hedgehop::avoidance::local_map
