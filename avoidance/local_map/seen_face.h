#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hedgehop::avoidance::local_map {

/// What was seen lately of a mover's surface, from above, moving along with it: a crown is no disc, and of one that the
/// view cuts, or that is too near to be matched, the last image shows the least.
class SeenFace {
 public:
  /// By what its mover has moved, m.
  void move(const Eigen::Vector2d& by_W);
  /// Adds an image's points, and forgets those that were seen 2 s before or earlier. @param t_s  rises from call to
  /// call.
  void see(double t_s, std::span<const Eigen::Vector2d> points_W);
  /// The convex hull of all that is remembered, turning from north to east; empty before anything was seen.
  std::vector<Eigen::Vector2d> hull_W() const;

 private:
  struct Corner {
    Eigen::Vector2d p_W;
    double t_s;
  };
  std::vector<Corner> corners_;  ///< of the hulls of images
};

/// From a point to a convex polygon of any number of corners, one at least, m; 0 inside.
double away_m(std::span<const Eigen::Vector2d> convex, const Eigen::Vector2d& p);

}  // namespace hedgehop::avoidance::local_map
