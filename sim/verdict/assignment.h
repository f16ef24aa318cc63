#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Assigns rows to columns one to one at the minimum total cost: all rows, or all columns if these are fewer.
/// @param cost  finite, of each row (first index) with each column. @return the column of each row.
/// Shortest augmenting paths, after [JonkerVolgenant1987].
std::vector<std::optional<Eigen::Index>> min_cost_assignment(const Eigen::MatrixXd& cost);

/// Matches the points of two sets one to one: the maximum number of pairs within the tolerance, with the minimum sum of
/// distances. @param a, b  m. @param tolerance_m  > 0.
/// @return the index in `b` of each point of `a`; nullopt for unmatched points.
std::vector<std::optional<Eigen::Index>> match_points(std::span<const Eigen::Vector3d> a,
                                                      std::span<const Eigen::Vector3d> b, double tolerance_m);

}  // namespace hedgehop::sim
