#include "sim/verdict/shortest_path.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

class ThetaStarSearch {
 public:
  ThetaStarSearch(const Eigen::AlignedBox2d& bounds, double cell_m,
                  const std::function<bool(const Eigen::Vector2d&)>& is_free)
      : origin_(bounds.min()), cell_m_(cell_m), is_free_(is_free) {
    rows_ = 1 + static_cast<int>(std::ceil(bounds.sizes().x() / cell_m));
    cols_ = 1 + static_cast<int>(std::ceil(bounds.sizes().y() / cell_m));
    const size_t count = static_cast<size_t>(rows_) * static_cast<size_t>(cols_);
    length_.assign(count, kInfinity);
    parent_.assign(count, -1);
    known_.assign(count, Occupancy::unknown);
    closed_.assign(count, false);
  }

  std::optional<double> run(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
    const int from = nearest(start), to = nearest(goal);
    if (!free(from) || !free(to)) return {};
    length_[index(from)] = 0.0;
    parent_[index(from)] = from;
    open_.push({distance(from, to), from});
    while (!open_.empty()) {
      const int node = open_.top().second;
      open_.pop();
      if (node == to) return length_[index(node)];
      if (closed_[index(node)]) continue;
      closed_[index(node)] = true;
      expand(node, to);
    }
    return {};
  }

 private:
  enum class Occupancy : char { unknown, free, occupied };

  static size_t index(int node) { return static_cast<size_t>(node); }
  Eigen::Vector2d point(int node) const { return origin_ + cell_m_ * Eigen::Vector2d(node / cols_, node % cols_); }
  double distance(int a, int b) const { return (point(a) - point(b)).norm(); }
  int nearest(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d cell = (p - origin_) / cell_m_;
    const int row = std::clamp(static_cast<int>(std::lround(cell.x())), 0, rows_ - 1);
    const int col = std::clamp(static_cast<int>(std::lround(cell.y())), 0, cols_ - 1);
    return row * cols_ + col;
  }
  bool free(int node) {
    Occupancy& known = known_[index(node)];
    if (known == Occupancy::unknown) known = is_free_(point(node)) ? Occupancy::free : Occupancy::occupied;
    return known == Occupancy::free;
  }
  /// Whether the grid points nearest to the segment, sampled every half cell, are free.
  bool is_visible(int a, int b) {
    const Eigen::Vector2d p = point(a), q = point(b);
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * (q - p).norm() / cell_m_)));
    for (int i = 1; i < steps; ++i) {
      if (!free(nearest(p + (q - p) * (static_cast<double>(i) / steps)))) return false;
    }
    return true;
  }
  void expand(int node, int to) {
    const int row = node / cols_, col = node % cols_;
    for (int next_row = std::max(0, row - 1); next_row <= std::min(rows_ - 1, row + 1); ++next_row) {
      for (int next_col = std::max(0, col - 1); next_col <= std::min(cols_ - 1, col + 1); ++next_col) {
        const int next = next_row * cols_ + next_col;
        if (closed_[index(next)] || !free(next)) continue;
        // Directly from the parent if the segment is free, otherwise through this point. The segment is checked only if
        // a path would be shorter than the known one.
        const int parent = parent_[index(node)];
        const double direct = length_[index(parent)] + distance(parent, next);
        const double bent = length_[index(node)] + distance(node, next);
        if (std::min(direct, bent) >= length_[index(next)]) continue;
        const bool visible = is_visible(parent, next);
        const double length = visible ? direct : bent;
        if (length >= length_[index(next)]) continue;
        length_[index(next)] = length;
        parent_[index(next)] = visible ? parent : node;
        open_.push({length + distance(next, to), next});
      }
    }
  }

  using Entry = std::pair<double, int>;
  Eigen::Vector2d origin_;
  double cell_m_;
  const std::function<bool(const Eigen::Vector2d&)>& is_free_;
  int rows_ = 0, cols_ = 0;
  std::vector<double> length_;
  std::vector<int> parent_;
  std::vector<Occupancy> known_;
  std::vector<bool> closed_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

std::optional<double> shortest_path_m(const Eigen::Vector2d& start_NE_m, const Eigen::Vector2d& goal_NE_m,
                                      const Eigen::AlignedBox2d& bounds_NE_m, double cell_m,
                                      const std::function<bool(const Eigen::Vector2d& p_NE_m)>& is_free) {
  return ThetaStarSearch(bounds_NE_m, cell_m, is_free).run(start_NE_m, goal_NE_m);
}

}  // namespace hedgehop::sim
