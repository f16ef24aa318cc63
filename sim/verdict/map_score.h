#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <vector>

#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Compares a module's map with the true corners of the scene at each decision. Corners and points of the map are
/// matched one to one within a tolerance (match_points()), so a second point at the same corner is false. A corner
/// counts after it was in sight for 10 s in total, because hidden corners cannot be mapped.
class MapScore {
 public:
  /// @param corners_W  true corners, m, at least one. @param p_start_W  start of the flight, m.
  /// @param tolerance_m  > 0, tolerance_m().
  MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W, double tolerance_m);

  /// Returns the maximum distance of a map point from its corner: 1 m, but at most a quarter of the shortest edge of
  /// the scene's buildings, so that no point is near two corners. @param shortest_edge_m  > 0, may be +inf.
  static double tolerance_m(double shortest_edge_m) { return std::fmin(1.0, 0.25 * shortest_edge_m); }

  /// Adds one decision. @param t_s  increasing. @param map_W  points of the map that the module uses, m; may be empty.
  /// @param in_sight  whether each corner is in sight of the camera.
  void add(double t_s, std::span<const Eigen::Vector3d> map_W, const std::vector<bool>& in_sight);

  /// Marks the points of the last map that are matched with a corner, counted or not, and adds the true corners with
  /// their matches. An empty record stays empty.
  void complete(MapRecord& map) const;

  /// Returns the metrics of the last map (docs/metrics.md); empty if the map never had a point:
  /// - `corners_seen`: number of corners that count; `corners_found`: recall, the share of these that are matched;
  /// - `map_precision`: share of the map's points that are matched; `false_landmarks`: number of unmatched points;
  ///   `false_on_ground`: number of these within the tolerance of the ground; `map_tolerance_m`;
  /// - `map_complete_s`: time since which recall and precision have both been at least 90 %; NaN if they are not;
  /// - `map_error_percent`: mean over the corners that count of |estimate - truth|, averaged over coordinates, divided
  /// by
  ///   the distance of the corner from the start of the flight; 100 % for an unmatched corner;
  ///   `converged_s`: time since which it has been within 3 %; NaN if it is not. [Shah2009] ch. 6 does not define the
  ///   denominator;
  /// - `aligned_corners_found`, `aligned_map_precision`: recall and precision after align_map(), of the shape of the
  /// map;
  ///   `map_shift_m`: mean displacement of the map's points by it. NaN if the map cannot be aligned.
  std::vector<MetricValue> metrics() const;

 private:
  std::vector<RecordedCorner> corners() const;
  double error_percent(size_t corner, const Eigen::Vector3d& p_W) const;
  void count_false(std::span<const Eigen::Vector3d> map_W);
  bool counts(size_t corner) const { return seen_s_[corner] >= kMinSeenS; }
  std::vector<MetricValue> aligned_metrics() const;

  static constexpr double kMinSeenS = 10.0;
  std::vector<Eigen::Vector3d> corners_W_;
  std::vector<Eigen::Vector3d> map_W_;  ///< the last map
  double tolerance_m_;
  std::vector<double> distances_m_, seen_s_;
  std::vector<bool> is_true_, is_found_;
  double last_t_s_ = 0.0;
  bool had_points_ = false;
  double error_percent_ = 100.0, converged_s_ = NAN, complete_s_ = NAN, recall_ = 0.0, precision_ = 0.0;
  int seen_count_ = 0, false_count_ = 0, false_on_ground_ = 0;
};

/// Returns whether each corner is in sight of a camera. @param world  solids that may hide corners; null for a camera
/// that sees through walls. @param X_WC  true pose of the camera. @param t_s  time of the movers' positions, >= 0.
std::vector<bool> corners_in_sight(std::span<const Eigen::Vector3d> corners_W, const vision::camera::Camera& camera,
                                   const Eigen::Isometry3d& X_WC, const CollisionWorld* world, double t_s);

}  // namespace hedgehop::sim
