#include "avoidance/landmark_map/orbit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::avoidance::landmark_map {

VelocityCommand orbit_command(const Orbit& orbit, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& at_NE,
                              double altitude_m) {
  constexpr double kBackPerS = 0.2;  // of a radius error: well below the bandwidth of a velocity loop
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

}  // namespace hedgehop::avoidance::landmark_map
