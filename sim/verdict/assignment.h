#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Assigns rows to columns one to one at the least total cost; all of the rows, or of the columns where those are
/// fewer. @param cost  finite, of each row (first index) with each column. @return the column of each row.
/// Shortest augmenting paths, after [JonkerVolgenant1987].
std::vector<std::optional<Eigen::Index>> least_cost_assignment(const Eigen::MatrixXd& cost);

/// Pairs points of two sets one to one: as many pairs as can be that lie no farther apart than the tolerance, and of
/// those the ones with the least sum of distances. @param a, b  m. @param tolerance_m  > 0.
/// @return the index in `b` of each point of `a`; none without a partner.
std::vector<std::optional<Eigen::Index>> match_points(std::span<const Eigen::Vector3d> a,
                                                      std::span<const Eigen::Vector3d> b, double tolerance_m);

}  // namespace hedgehop::sim
