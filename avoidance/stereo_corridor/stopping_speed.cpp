#include "avoidance/stereo_corridor/stopping_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::avoidance::stereo_corridor {

double stopping_speed_mps(const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
                          double radius_m, const Eigen::Vector3d& v_WB_C, double acceleration_mps2, double hull_m) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  constexpr double kReactionS = 1.0;    // from the image to the deceleration: command latency, and tilt of the vehicle
  constexpr double kMinSpeedMps = 0.5;  // keeps a direction of flight, so that the obstacle stays in view
  if (!is_moving(v_WB_C)) return kUnlimited;
  if (!(v_WB_C.z() > 0.0)) return kMinSpeedMps;
  // A direction outside the image counts as the nearest pixel of its edge, the space next to it.
  const cv::Size image = pyramid.image();
  const double u = geometry.center_u_px + geometry.focal_px * v_WB_C.x() / v_WB_C.z();
  const double v = geometry.center_v_px + geometry.focal_px * v_WB_C.y() / v_WB_C.z();
  const cv::Point pixel(static_cast<int>(std::lround(std::clamp(u, 0.0, image.width - 1.0))),
                        static_cast<int>(std::lround(std::clamp(v, 0.0, image.height - 1.0))));
  const vision::stereo::Corridor ahead = vision::stereo::examine_corridor(pyramid, geometry, pixel, radius_m, 0.0);
  if (ahead.state == vision::stereo::Corridor::State::unknown) return kUnlimited;
  // v t + v^2 / 2a = distance, solved for v.
  const double distance_m = std::max(0.0, ahead.z_m * geometry.ray_at_unit_depth(pixel).norm() - hull_m);
  const double lost_mps = acceleration_mps2 * kReactionS;
  return std::max(kMinSpeedMps, std::sqrt(lost_mps * lost_mps + 2.0 * acceleration_mps2 * distance_m) - lost_mps);
}

}  // namespace hedgehop::avoidance::stereo_corridor
