#include "sim/verdict/assignment.h"

#include <algorithm>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

using Eigen::Index;

constexpr Index kNone = -1;

/// Extends an assignment by one row at a time. Dijkstra's method finds the augmenting path of minimum cost; the prices
/// of rows and columns keep the reduced costs >= 0.
class Augmenter {
 public:
  explicit Augmenter(const Eigen::MatrixXd& cost)
      : cost_(cost),
        row_price_(Eigen::VectorXd::Zero(cost.rows())),
        column_price_(Eigen::VectorXd::Zero(cost.cols())),
        row_of_(static_cast<size_t>(cost.cols()), kNone) {}

  void assign(Index row) {
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(cost_.cols(), kInfinity);
    std::vector<Index> before(row_of_.size(), kNone);  // previous column of the path; kNone for `row` itself
    std::vector<char> settled(row_of_.size(), 0);
    Index from = kNone, free = kNone;
    double so_far = 0.0;
    for (Index at = row; free == kNone;) {
      Index next = kNone;
      for (Index j = 0; j < cost_.cols(); ++j) {
        if (settled[static_cast<size_t>(j)]) continue;
        const double through = so_far + cost_(at, j) - row_price_(at) - column_price_(j);
        if (through < distance(j)) {
          distance(j) = through;
          before[static_cast<size_t>(j)] = from;
        }
        if (next == kNone || distance(j) < distance(next)) next = j;
      }
      settled[static_cast<size_t>(next)] = 1;
      so_far = distance(next);
      from = next;
      at = row_of_[static_cast<size_t>(next)];
      if (at == kNone) free = next;
    }
    row_price_(row) += so_far;
    for (Index j = 0; j < cost_.cols(); ++j) {
      if (!settled[static_cast<size_t>(j)] || j == free) continue;
      row_price_(row_of_[static_cast<size_t>(j)]) += so_far - distance(j);
      column_price_(j) -= so_far - distance(j);
    }
    for (Index j = free; j != kNone;) {
      const Index previous = before[static_cast<size_t>(j)];
      row_of_[static_cast<size_t>(j)] = previous == kNone ? row : row_of_[static_cast<size_t>(previous)];
      j = previous;
    }
  }

  const std::vector<Index>& row_of() const { return row_of_; }

 private:
  const Eigen::MatrixXd& cost_;
  Eigen::VectorXd row_price_, column_price_;
  std::vector<Index> row_of_;  ///< of each column
};

}  // namespace

std::vector<std::optional<Index>> min_cost_assignment(const Eigen::MatrixXd& cost) {
  const bool turned = cost.rows() > cost.cols();
  const Eigen::MatrixXd wide = turned ? Eigen::MatrixXd(cost.transpose()) : cost;
  Augmenter augmenter(wide);
  for (Index row = 0; row < wide.rows(); ++row) augmenter.assign(row);
  std::vector<std::optional<Index>> columns(static_cast<size_t>(cost.rows()));
  for (Index j = 0; j < wide.cols(); ++j) {
    const Index row = augmenter.row_of()[static_cast<size_t>(j)];
    if (row == kNone) continue;
    if (turned) {
      columns[static_cast<size_t>(j)] = row;
    } else {
      columns[static_cast<size_t>(row)] = j;
    }
  }
  return columns;
}

std::vector<std::optional<Index>> match_points(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b,
                                               double tolerance_m) {
  const auto rows = static_cast<Index>(a.size()), columns = static_cast<Index>(b.size());
  if (rows == 0 || columns == 0) return std::vector<std::optional<Index>>(a.size());
  // A pair beyond the tolerance costs more than all valid pairs together, so that it never displaces a valid one.
  const double refused_m = tolerance_m * static_cast<double>(std::min(rows, columns) + 1);
  Eigen::MatrixXd cost_m(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      const double distance_m = (a[static_cast<size_t>(i)] - b[static_cast<size_t>(j)]).norm();
      cost_m(i, j) = distance_m <= tolerance_m ? distance_m : refused_m;
    }
  }
  std::vector<std::optional<Index>> partners = min_cost_assignment(cost_m);
  for (Index i = 0; i < rows; ++i) {
    std::optional<Index>& partner = partners[static_cast<size_t>(i)];
    if (partner && cost_m(i, *partner) > tolerance_m) partner.reset();
  }
  return partners;
}

}  // namespace hedgehop::sim
