#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

/// What a module's map of the world was at the end of a flight, beside the truth, and what it planned meanwhile.
namespace hedgehop::sim {

struct RecordedPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
  std::optional<bool> is_true;  ///< is matched with a true corner (MapScore); none where corners are unknown
};

struct RecordedCorner {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< true, m
  bool counts = false;                            ///< was in sight long enough (MapScore)
  bool found = false;                             ///< is matched with a point of the map (MapScore)
};

struct PlannedPath {
  double t_s = 0.0;                        ///< of the decision; it holds until the next one
  std::vector<Eigen::Vector2d> places_NE;  ///< to turn at, m, the last one included
};

struct MapRecord {
  std::vector<RecordedPoint> points;
  std::vector<RecordedCorner> corners;
  std::vector<Eigen::Vector2d> course_NE;  ///< m
  std::vector<PlannedPath> paths;          ///< detours, in order of time; MapLog (sim/loop) chooses them

  bool empty() const { return points.empty() && course_NE.empty(); }
};

}  // namespace hedgehop::sim
