#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Compares a module's map with the corners that the scene truly has, from decision to decision. Corners and points of
/// the map are matched one to one, no farther apart than a tolerance in meters (match_points()): a second point at the
/// same corner is as false as one at none. A corner counts once it was in sight for 10 s in all: no image shows what
/// walls hide all the while.
class MapScore {
 public:
  /// @param corners_W  true corners, m, at least one. @param p_start_W  where the flight began, m.
  /// @param tolerance_m  > 0, tolerance_m().
  MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W, double tolerance_m);

  /// How far from its corner a point of the map may lie: 1 m, but never more than a quarter of the shortest edge of the
  /// scene's buildings, so that no point is near two corners. @param shortest_edge_m  > 0, may be +inf.
  static double tolerance_m(double shortest_edge_m) { return std::fmin(1.0, 0.25 * shortest_edge_m); }

  /// @param t_s  rising. @param map_W  points of the map that the module would act on, m; may be empty.
  /// @param in_sight  which corners the camera sees now, as many as corners.
  void add(double t_s, std::span<const Eigen::Vector3d> map_W, const std::vector<bool>& in_sight);

  /// Adds to the record of the last map which of its points are matched with a corner, counting or not, and the true
  /// corners, found where matched. An empty record stays empty.
  void complete(MapRecord& map) const;

  /// Of the last map (docs/metrics.md); empty when the map never held a point:
  /// - `corners_found`: recall, the share of the corners that count (`corners_seen`, how many) that are matched;
  /// - `map_precision`: share of the map's points that are matched; `false_landmarks`: how many are not,
  ///   `false_on_ground`: how many of those lie within the tolerance of the ground; `map_tolerance_m`;
  /// - `map_complete_s`: since when recall and precision have both been at least 90 %, NaN when they are not;
  /// - `map_error_percent`: mean over the corners that count of |estimate - truth|, meaned over its coordinates, as a
  ///   share of the distance from where the flight began to the corner, 100 % for a corner without a match;
  ///   `converged_s`: since when that has been within 3 %, NaN when it is not. [Shah2009] ch. 6 leaves the denominator
  ///   open.
  std::vector<MetricValue> metrics() const;

 private:
  std::vector<RecordedCorner> corners() const;
  double error_percent(size_t corner, const Eigen::Vector3d& p_W) const;
  void count_false(std::span<const Eigen::Vector3d> map_W);

  std::vector<Eigen::Vector3d> corners_W_;
  double tolerance_m_;
  std::vector<double> distances_m_, seen_s_;
  std::vector<bool> is_true_, is_found_;
  double last_t_s_ = 0.0;
  bool ever_ = false;
  double error_percent_ = 100.0, converged_s_ = NAN, complete_s_ = NAN, recall_ = 0.0, precision_ = 0.0;
  int seen_count_ = 0, false_count_ = 0, false_on_ground_ = 0;
};

}  // namespace hedgehop::sim
