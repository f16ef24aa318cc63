#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/landmark_map/map_route.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"
#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// The lateral flight of the thesis: a level circle around an object to which the nose points. [Shah2009] ch. 4.
struct Orbit {
  double north_m = 0.0, east_m = 0.0;
  double rate_radps = 6.283185307179587e-3;  ///< 0.36 deg/s, [Shah2009] table 4.1
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Orbit> auto& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "north coordinate of the object at the center"});
  v("east", c.east_m, {.unit = "m", .meaning = "east coordinate of the object at the center"});
  v("rate", c.rate_radps, {.unit = "deg/s", .meaning = "angular rate of the circle, clockwise seen from above"});
}

/// Returns the velocity along the circle through `start_NE`, with a correction of radius errors.
/// @param start_NE  start of the flight, m. @param at_NE  position of the vehicle, m. @param altitude_m  to hold.
/// Source: [Shah2009] eq. (4.1), its rates. Differs: wind moves the vehicle off the circle, so the radius is
/// controlled.
VelocityCommand orbit_command(const Orbit& orbit, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& at_NE,
                              double altitude_m);

/// Returns the circle as a closed polygon of 72 sides, from its start, m.
std::vector<Eigen::Vector2d> orbit_course(const Orbit& orbit, const Eigen::Vector2d& start_NE);

/// Follows the straight course from start to goal and flies around obstacles of the map. Not in the thesis: [Shah2009]
/// sec. on the avoidance maneuver leaves it to other work.
class CourseKeeper {
 public:
  struct Config {
    double speed_mps = 0.0;    ///< > 0
    double clearance_m = 0.0;  ///< distance of the body origin from outlines, >= 0
    double behind_m = 0.0;     ///< extent of outlines behind the observed corners, >= 0
  };
  CourseKeeper(const Config& config, const Eigen::Vector2d& start_NE) : config_(config), start_NE_(start_NE) {}

  /// Sets the obstacles: outlines of the landmarks that are certain and high enough.
  void set_obstacles(const vision::landmarks::LandmarkMap& map);
  /// Returns the velocity along the course. Around obstacles it is along the shortest path to the first point from
  /// which the rest of the course is free. Hovers if there is no path. @param at_NE  position of the vehicle, m.
  Decision follow(const Eigen::Vector2d& at_NE, const Goal& goal);

  const std::vector<PlanHull>& obstacles() const { return hulls_; }
  const std::vector<Eigen::Vector2d>& path_NE() const {
    return path_NE_;
  }                                                      ///< planned path without the position of the vehicle
  double off_course_m() const { return off_course_m_; }  ///< >= 0
  double max_off_course_m() const { return max_off_course_m_; }

 private:
  Config config_;
  Eigen::Vector2d start_NE_;
  std::vector<PlanHull> hulls_;
  std::vector<Eigen::Vector2d> path_NE_;
  double off_course_m_ = 0.0, max_off_course_m_ = 0.0;
};

/// Returns whether a landmark is certain and high enough to be part of the outline of an obstacle.
bool bounds_obstacle(const vision::landmarks::LandmarkMap& map, const vision::landmarks::MappedLandmark& mapped);

/// Returns the maximum eigenvalue of a covariance.
double max_variance(const Eigen::MatrixXd& P);

}  // namespace hedgehop::avoidance::landmark_map
