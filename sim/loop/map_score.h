#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "sim/loop/flight.h"

namespace hedgehop::sim {

/// Compares a module's map with the corners that the scene truly has, from decision to decision. The error of a corner
/// is the mean over its coordinates of |estimate - truth|, of the map's nearest point, as a share of the distance from
/// where the flight began to the corner. [Shah2009] ch. 6 leaves its denominator open.
class MapScore {
 public:
  /// @param corners_W  true corners, m, at least one. @param p_start_W  where the flight began, m.
  MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W);

  /// @param map_W  points of the map, m; may be empty: then every error is 100 %.
  void add(double t_s, std::span<const Eigen::Vector3d> map_W);

  /// `map_error_percent`, `converged_s` (since when that error has been within 3 %; NaN when it is not),
  /// `corners_found` (share of the corners within 3 %), `false_landmarks` (points of the map within 3 % of no corner)
  /// and `false_share`. Empty when the map never held a point.
  std::vector<MetricValue> metrics() const;

 private:
  struct Corner {
    Eigen::Vector3d p_W;
    double distance_m;
  };
  double error_percent(const Corner& corner, const Eigen::Vector3d& p_W) const;

  std::vector<Corner> corners_;
  bool ever_ = false;
  double error_percent_ = 100.0, converged_s_ = NAN, found_ = 0.0, false_share_ = 0.0;
  int false_count_ = 0;
};

}  // namespace hedgehop::sim
