#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/landmark_map/map_route.h"
#include "avoidance/module.h"
#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// Follows the straight course from start to goal and flies around what the map has on it. Ours: [Shah2009] sec. on the
/// avoidance maneuver leaves it to other work.
class CourseKeeper {
 public:
  struct Config {
    double speed_mps = 0.0;    ///< > 0
    double clearance_m = 0.0;  ///< of the body's origin from outlines, >= 0
    double behind_m = 0.0;     ///< outlines reach so far behind the corners seen of them, >= 0
  };
  CourseKeeper(const Config& config, const Eigen::Vector2d& start_NE) : config_(config), start_NE_(start_NE) {}

  /// Sets the obstacles: outlines of what the map holds well enough and high enough.
  void set_obstacles(const vision::landmarks::LandmarkMap& map);
  /// Returns the velocity along the course; around obstacles, along the shortest path to the first point from which the
  /// rest of the course is free. Hovers where there is no path. @param at_NE  the vehicle, m.
  Decision follow(const Eigen::Vector2d& at_NE, const Goal& goal);

  const std::vector<PlanHull>& obstacles() const { return hulls_; }
  const std::vector<Eigen::Vector2d>& path_NE() const { return path_NE_; }  ///< planned, without the vehicle's place
  double off_course_m() const { return off_course_m_; }                     ///< >= 0
  double most_off_course_m() const { return most_off_course_m_; }

 private:
  Config config_;
  Eigen::Vector2d start_NE_;
  std::vector<PlanHull> hulls_;
  std::vector<Eigen::Vector2d> path_NE_;
  double off_course_m_ = 0.0, most_off_course_m_ = 0.0;
};

/// Whether a landmark is certain and high enough to bound an obstacle, where another lies near.
bool bounds_obstacle(const vision::landmarks::LandmarkMap& map, const vision::landmarks::MappedLandmark& mapped);

/// Returns the largest eigenvalue of a covariance.
double greatest_variance(const Eigen::MatrixXd& P);

}  // namespace hedgehop::avoidance::landmark_map
