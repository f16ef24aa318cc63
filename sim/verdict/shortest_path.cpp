#include "sim/verdict/shortest_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

using Point = Eigen::Vector2d;
using Polyline = std::vector<Point>;

/// The grid of a plan, with the clearance of each point once it is known.
class PlanGrid {
 public:
  PlanGrid(const Eigen::AlignedBox2d& bounds, double cell_m, const PlanClearance& clearance_m)
      : origin_(bounds.min()), cell_m_(cell_m), clearance_m_(clearance_m) {
    rows_ = 1 + static_cast<int>(std::ceil(bounds.sizes().x() / cell_m));
    cols_ = 1 + static_cast<int>(std::ceil(bounds.sizes().y() / cell_m));
    known_m_.assign(count(), std::numeric_limits<double>::quiet_NaN());
  }
  size_t count() const { return static_cast<size_t>(rows_) * static_cast<size_t>(cols_); }
  int rows() const { return rows_; }
  int cols() const { return cols_; }
  double cell_m() const { return cell_m_; }
  Point point(int node) const { return origin_ + cell_m_ * Point(node / cols_, node % cols_); }
  int nearest(const Point& p) const {
    const Point cell = (p - origin_) / cell_m_;
    const int row = std::clamp(static_cast<int>(std::lround(cell.x())), 0, rows_ - 1);
    const int col = std::clamp(static_cast<int>(std::lround(cell.y())), 0, cols_ - 1);
    return row * cols_ + col;
  }
  double clearance_m(int node) {
    double& known_m = known_m_[static_cast<size_t>(node)];
    if (std::isnan(known_m)) known_m = clearance_m_(point(node));
    return known_m;
  }
  bool is_free(const Point& p) const { return clearance_m_(p) > 0.0; }

  /// Returns whether the segment is free, by steps as long as the clearance allows.
  bool is_visible(const Point& a, const Point& b) {
    constexpr double kMinStepM = 0.01;  // short of any hull
    const double length_m = (b - a).norm();
    for (double at_m = 0.0; at_m < length_m;) {
      const Point p = a + (b - a) * (at_m / length_m);
      const int node = nearest(p);
      double free_m = clearance_m(node) - (point(node) - p).norm();  // a lower bound
      if (free_m < 0.5 * cell_m_) free_m = clearance_m_(p);
      if (free_m <= 0.0) return false;
      at_m += std::max(free_m, kMinStepM);
    }
    return is_free(b);
  }

 private:
  Point origin_;
  double cell_m_;
  const PlanClearance& clearance_m_;
  int rows_ = 0, cols_ = 0;
  std::vector<double> known_m_;
};

/// Theta*: parents are any nodes in sight. The nodes are the grid's points, the start and the goal's circle.
class ThetaStarSearch {
 public:
  ThetaStarSearch(PlanGrid& grid, const Point& start, const GoalCircle& goal)
      : grid_(grid), start_(start), goal_(goal) {
    start_node_ = static_cast<int>(grid.count());
    goal_node_ = start_node_ + 1;
    length_.assign(grid.count() + 2, kInfinity);
    parent_.assign(grid.count() + 2, -1);
    closed_.assign(grid.count() + 2, false);
  }

  /// Returns the corners of the path, start and end included; empty if there is none.
  Polyline run() {
    length_[index(start_node_)] = 0.0;
    parent_[index(start_node_)] = start_node_;
    open_.push({to_goal_m(start_), start_node_});
    while (!open_.empty()) {
      const int node = open_.top().second;
      open_.pop();
      if (node == goal_node_) return path();
      if (closed_[index(node)]) continue;
      closed_[index(node)] = true;
      expand(node);
    }
    return {};
  }

 private:
  static size_t index(int node) { return static_cast<size_t>(node); }
  Point point(int node) const { return node == start_node_ ? start_ : grid_.point(node); }
  double to_goal_m(const Point& p) const { return std::max(0.0, (p - goal_.center_NE_m).norm() - goal_.radius_m); }
  /// Returns the point of the goal's circle nearest to a point.
  Point end_from(const Point& p) const {
    const double distance_m = (p - goal_.center_NE_m).norm();
    return distance_m <= goal_.radius_m ? p : p + (goal_.center_NE_m - p) * (1.0 - goal_.radius_m / distance_m);
  }
  Polyline path() const {
    Polyline points{end_from(point(parent_[index(goal_node_)]))};
    for (int node = parent_[index(goal_node_)]; node != start_node_; node = parent_[index(node)]) {
      points.push_back(point(node));
    }
    points.push_back(start_);
    std::ranges::reverse(points);
    return points;
  }

  void expand(int node) {
    const int center = grid_.nearest(point(node)), row = center / grid_.cols(), col = center % grid_.cols();
    for (int next_row = std::max(0, row - 1); next_row <= std::min(grid_.rows() - 1, row + 1); ++next_row) {
      for (int next_col = std::max(0, col - 1); next_col <= std::min(grid_.cols() - 1, col + 1); ++next_col) {
        const int next = next_row * grid_.cols() + next_col;
        // Directly from the parent if it is in sight, otherwise through this node.
        if (closed_[index(next)] || grid_.clearance_m(next) <= 0.0) continue;
        if (!reach(parent_[index(node)], next, grid_.point(next))) reach(node, next, grid_.point(next));
      }
    }
    if (to_goal_m(point(node)) > 1.5 * grid_.cell_m()) return;
    for (const int from : {parent_[index(node)], node}) reach(from, goal_node_, end_from(point(from)));
  }

  /// Reaches a node from another one in sight, if that is shorter than the known path. Sight is only checked then.
  bool reach(int from, int next, const Point& there) {
    const double length_m = length_[index(from)] + (point(from) - there).norm();
    if (length_m >= length_[index(next)] || !grid_.is_visible(point(from), there)) return false;
    length_[index(next)] = length_m;
    parent_[index(next)] = from;
    open_.push({length_m + to_goal_m(there), next});
    return true;
  }

  using Entry = std::pair<double, int>;
  PlanGrid& grid_;
  Point start_;
  GoalCircle goal_;
  int start_node_, goal_node_;
  std::vector<double> length_;
  std::vector<int> parent_;
  std::vector<bool> closed_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

double length_m(const Polyline& path) {
  double sum_m = 0.0;
  for (size_t i = 1; i < path.size(); ++i) sum_m += (path[i] - path[i - 1]).norm();
  return sum_m;
}

/// Returns the largest share in [0, 1] that holds, if smaller ones hold too.
template <class Holds>
double largest(const Holds& holds) {
  if (holds(1.0)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < 10; ++halving) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

/// Pulls a path tight: moves each corner toward the straight line, cuts corners, and removes those that are not needed.
/// Every step shortens the path and keeps it free.
class Tightener {
 public:
  Tightener(PlanGrid& grid, const GoalCircle& goal) : grid_(grid), goal_(goal) {}

  Polyline run(Polyline path) {
    constexpr int kRounds = 30, kCuts = 4;
    for (int round = 0; round < kRounds; ++round) {
      const double before_m = length_m(path);
      drop_corners(path);
      pull(path);
      move_end(path);
      if (round < kCuts) cut(path);
      if (round >= kCuts && length_m(path) > before_m * (1.0 - 1e-4)) break;
    }
    return path;
  }

 private:
  void drop_corners(Polyline& path) {
    for (size_t i = 1; i + 1 < path.size();) {
      if (grid_.is_visible(path[i - 1], path[i + 1])) {
        path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
  }
  void pull(Polyline& path) {
    for (size_t i = 1; i + 1 < path.size(); ++i) {
      const Point a = path[i - 1], b = path[i + 1], from = path[i];
      const double along = (from - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-12);
      const Point to = a + (b - a) * std::clamp(along, 0.0, 1.0);
      const auto at = [&](double share) { return Point(from + share * (to - from)); };
      path[i] = at(largest([&](double s) { return grid_.is_visible(a, at(s)) && grid_.is_visible(at(s), b); }));
    }
  }
  void cut(Polyline& path) {
    Polyline cut{path.front()};
    for (size_t i = 1; i + 1 < path.size(); ++i) {
      const Point corner = path[i];
      const auto toward = [&](const Point& other, double share) {
        return Point(corner + 0.5 * share * (other - corner));
      };
      const double share =
          largest([&](double s) { return grid_.is_visible(toward(path[i - 1], s), toward(path[i + 1], s)); });
      cut.push_back(toward(path[i - 1], share));
      cut.push_back(toward(path[i + 1], share));
    }
    cut.push_back(path.back());
    path = std::move(cut);
  }
  void move_end(Polyline& path) {
    const Point& from = path[path.size() - 2];
    const Point end = goal_.center_NE_m + goal_.radius_m * (from - goal_.center_NE_m).normalized();
    if ((end - from).norm() < (path.back() - from).norm() && grid_.is_visible(from, end)) path.back() = end;
  }

  PlanGrid& grid_;
  GoalCircle goal_;
};

}  // namespace

std::optional<double> shortest_path_m(const Eigen::Vector2d& start_NE_m, const GoalCircle& goal,
                                      const Eigen::AlignedBox2d& bounds_NE_m, double cell_m,
                                      const PlanClearance& clearance_m) {
  PlanGrid grid(bounds_NE_m, cell_m, clearance_m);
  if (!grid.is_free(start_NE_m)) return {};
  if ((start_NE_m - goal.center_NE_m).norm() <= goal.radius_m) return 0.0;
  Polyline path = ThetaStarSearch(grid, start_NE_m, goal).run();
  if (path.empty()) return {};
  return length_m(Tightener(grid, goal).run(std::move(path)));
}

}  // namespace hedgehop::sim
