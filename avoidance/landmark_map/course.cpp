#include "avoidance/landmark_map/course.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "avoidance/go_to_goal.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

using vision::landmarks::LandmarkMap;

constexpr double kLinkM = 14.0;     // landmarks within this distance belong to one obstacle: the width of a facade
constexpr double kLowestM = 4.0;    // minimum altitude of an obstacle landmark; lower ones are in the grass
constexpr double kMaxSigmaM = 2.0;  // maximum uncertainty of an obstacle landmark

}  // namespace

VelocityCommand orbit_command(const Orbit& orbit, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& at_NE,
                              double altitude_m) {
  constexpr double kBackPerS = 0.2;  // gain on the radius error: well below the bandwidth of a velocity loop
  const Eigen::Vector2d middle(orbit.north_m, orbit.east_m);
  const Eigen::Vector2d out = at_NE - middle;
  const double radius_m = std::max((start_NE - middle).norm(), 1.0), now_m = std::max(out.norm(), 1.0);
  VelocityCommand command;
  command.v_WB_W = orbit.rate_radps * Eigen::Vector2d(-out.y(), out.x()) + kBackPerS * (radius_m - now_m) * out / now_m;
  command.heading_rad = std::atan2(-out.y(), -out.x());
  command.altitude_m = altitude_m;
  return command;
}

std::vector<Eigen::Vector2d> orbit_course(const Orbit& orbit, const Eigen::Vector2d& start_NE) {
  constexpr int kSides = 72;
  const Eigen::Vector2d middle(orbit.north_m, orbit.east_m);
  std::vector<Eigen::Vector2d> circle;
  for (int k = 0; k <= kSides; ++k) {
    circle.push_back(middle + Eigen::Rotation2Dd(2.0 * std::numbers::pi * k / kSides) * (start_NE - middle));
  }
  return circle;
}

bool bounds_obstacle(const LandmarkMap& map, const vision::landmarks::MappedLandmark& mapped) {
  if (!map.confirmed(mapped)) return false;
  const Eigen::Matrix3d P_W = vision::landmarks::covariance_W(mapped.landmark);
  const double variance = max_variance(P_W.topLeftCorner<2, 2>());
  return -vision::landmarks::position_W(mapped.landmark).z() >= kLowestM && variance <= kMaxSigmaM * kMaxSigmaM;
}

double max_variance(const Eigen::MatrixXd& P) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

void CourseKeeper::set_obstacles(const LandmarkMap& map) {
  std::vector<Eigen::Vector2d> points, seen_from;
  for (const vision::landmarks::MappedLandmark& mapped : map.landmarks()) {
    if (!bounds_obstacle(map, mapped)) continue;
    points.push_back(vision::landmarks::position_W(mapped.landmark).head<2>());
    seen_from.push_back(mapped.landmark.X_WA.translation().head<2>());
  }
  std::vector<Eigen::Vector2d> filled;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto near = [&](const Eigen::Vector2d& p) { return (p - points[i]).norm() <= kLinkM; };
    const Eigen::Vector2d away = (points[i] - seen_from[i]).normalized();
    filled.push_back(points[i]);
    filled.push_back(points[i] + config_.behind_m * away);
    if (std::ranges::count_if(points, near) >= 2) continue;
    // A single corner is the end of a facade on an unknown side: add half a facade to both sides.
    const Eigen::Vector2d aside = 0.5 * kLinkM * Eigen::Vector2d(-away.y(), away.x());
    for (const Eigen::Vector2d& end : {Eigen::Vector2d(points[i] - aside), Eigen::Vector2d(points[i] + aside)}) {
      filled.push_back(end);
      filled.push_back(end + config_.behind_m * away);
    }
  }
  hulls_ = plan_hulls(filled, std::max(kLinkM, config_.behind_m));
}

Decision CourseKeeper::follow(const Eigen::Vector2d& at_NE, const Goal& goal) {
  constexpr double kLeadM = 6.0,
                   kStepM =
                       3.0;  // minimum distance ahead at which the course is rejoined; spacing of the tested points
  constexpr double kOnCourseM = 2.0;  // maximum offset without the status "rejoin"
  constexpr double kSlowM = 4.0;      // distance to the goal within which the speed decreases in proportion
  const Eigen::Vector2d end = goal.p_WG.head<2>();
  const Eigen::Vector2d course = end - start_NE_;
  const double length_m = course.norm();
  const Eigen::Vector2d along = length_m > 0.0 ? Eigen::Vector2d(course / length_m) : Eigen::Vector2d::UnitX();
  const double done_m = (at_NE - start_NE_).dot(along);
  off_course_m_ = std::abs((at_NE - start_NE_).dot(Eigen::Vector2d(-along.y(), along.x())));
  max_off_course_m_ = std::max(max_off_course_m_, off_course_m_);

  const auto free = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    return std::ranges::all_of(
        hulls_, [&](const PlanHull& hull) { return distance_to_hull(hull, from, to) > config_.clearance_m; });
  };
  Eigen::Vector2d join = end;
  for (double s = done_m + kLeadM; s < length_m; s += kStepM) {
    const Eigen::Vector2d place = start_NE_ + s * along;
    if (!free(place, end)) continue;
    join = place;
    break;
  }
  const auto path = path_around(hulls_, at_NE, join, config_.clearance_m);
  if (!path) return {HoverCommand{}, "no_path", {}};
  path_NE_ = *path;

  const char* status = path_NE_.size() > 1 ? "avoid" : off_course_m_ > kOnCourseM ? "rejoin" : "cruise";
  const Eigen::Vector2d to_end = end - at_NE;
  VelocityCommand command;
  command.v_WB_W = velocity_to_goal(path_NE_.front() - at_NE, config_.speed_mps, 0.0);
  if (to_end.norm() < kSlowM) command.v_WB_W *= to_end.norm() / kSlowM;
  command.heading_rad = std::atan2(command.v_WB_W.y(), command.v_WB_W.x());
  command.altitude_m = -goal.p_WG.z();
  return {command, status, {}};
}

}  // namespace hedgehop::avoidance::landmark_map
