#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Compares a module's map with the corners that the scene truly has, from decision to decision. The error of a corner
/// is the mean over its coordinates of |estimate - truth|, of the map's nearest point, as a share of the distance from
/// where the flight began to the corner. [Shah2009] ch. 6 leaves its denominator open. A corner counts once it was in
/// sight for 10 s in all: no image shows what walls hide all the while.
class MapScore {
 public:
  /// @param corners_W  true corners, m, at least one. @param p_start_W  where the flight began, m.
  MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W);

  /// @param t_s  rising. @param map_W  points of the map, m; may be empty: then every error is 100 %.
  /// @param in_sight  which corners the camera sees now, as many as corners.
  void add(double t_s, std::span<const Eigen::Vector3d> map_W, const std::vector<bool>& in_sight);

  /// Adds to the record of the last map which of its points lie within 3 % of a corner, counting or not, and the true
  /// corners, found where a point lies within 3 %. An empty record stays empty.
  void complete(MapRecord& map) const;

  /// `map_error_percent`, `converged_s` (since when that error has been within 3 %; NaN when it is not), of the corners
  /// that count; `corners_seen` (how many count), `corners_found` (share of those within 3 %), `false_landmarks`
  /// (points of the map within 3 % of no corner, counting or not), `false_on_ground` (those of them within 3 % of the
  /// ground) and `false_share`. Empty when the map never held a point.
  std::vector<MetricValue> metrics() const;

 private:
  std::vector<RecordedCorner> corners() const;
  double error_percent(size_t corner, const Eigen::Vector3d& p_W) const;

  std::vector<Eigen::Vector3d> corners_W_;
  std::vector<double> distances_m_, seen_s_;
  std::vector<bool> is_true_, is_found_;
  double last_t_s_ = 0.0;
  bool ever_ = false;
  double error_percent_ = 100.0, converged_s_ = NAN, found_ = 0.0, false_share_ = 0.0;
  int seen_count_ = 0, false_count_ = 0, false_on_ground_ = 0;
};

}  // namespace hedgehop::sim
