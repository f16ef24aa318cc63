#include "avoidance/stereo/passed_obstacles.h"

#include <algorithm>
#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::stereo {

void PassedObstacles::update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid,
                             const vision::stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC) {
  if (config_.radius_m == 0.0) return;
  p_WC_ = X_WC.translation();
  const Eigen::Isometry3d X_CW = X_WC.inverse();
  hidden_.insert(hidden_.end(), visible_.begin(), visible_.end());
  std::erase_if(hidden_, [&](const Point& point) {
    const Eigen::Vector3d p_CP = X_CW * point.p_WP;
    return seconds(t_ns - point.t_ns) > config_.keep_s || p_CP.norm() > config_.near_m ||
           in_view(p_CP, pyramid, geometry);
  });

  // The nearest point of each block represents it.
  constexpr int kLevel = 3;
  const int level = std::min(kLevel, pyramid.top()), size = 1 << level;
  const double near16 = geometry.disparity16(config_.near_m);
  visible_.clear();
  for (int row = 0; row < pyramid.level(level).rows; ++row) {
    for (int col = 0; col < pyramid.level(level).cols; ++col) {
      const int d = pyramid.disparity16(level, row, col);
      if (d < near16) continue;
      const cv::Point center(col * size + size / 2, row * size + size / 2);
      visible_.push_back({X_WC * (geometry.z_m(d) * geometry.ray_at_unit_depth(center)), t_ns});
    }
  }
  constexpr double kRecentS = 1.0;
  std::erase_if(recent_, [&](const Point& point) { return seconds(t_ns - point.t_ns) > kRecentS; });
  recent_.insert(recent_.end(), visible_.begin(), visible_.end());
}

bool PassedObstacles::in_view(const Eigen::Vector3d& p_CP, const vision::stereo::DepthPyramid& pyramid,
                              const vision::stereo::StereoGeometry& geometry) const {
  if (!(p_CP.z() > 0.0)) return false;
  const double u = geometry.center_u_px + geometry.focal_px * p_CP.x() / p_CP.z();
  const double v = geometry.center_v_px + geometry.focal_px * p_CP.y() / p_CP.z();
  // A point with a column smaller than its disparity is out of view of the right camera.
  const double first_u = geometry.focal_px * geometry.baseline_m / p_CP.z();
  const cv::Size image = pyramid.image();
  return u >= first_u && u <= image.width - 1 && v >= 0 && v <= image.height - 1;
}

bool PassedObstacles::free(const Eigen::Vector3d& direction_W, double reach_m, Among among) const {
  constexpr double kNoCloser = 0.9;
  const Eigen::Vector3d ahead = direction_W.normalized();
  const auto is_met = [&](const Point& point) {
    const Eigen::Vector3d p = point.p_WP - p_WC_;
    if (among == Among::all && p.norm() < config_.radius_m) return true;
    const double along_m = p.dot(ahead);
    const double aside_m = std::min(config_.radius_m, kNoCloser * p.norm());
    const double past_m = std::max(0.0, along_m - reach_m);
    return along_m > 0.0 && p.squaredNorm() - along_m * along_m + past_m * past_m < aside_m * aside_m;
  };
  return std::ranges::none_of(hidden_, is_met) && (among == Among::hidden || std::ranges::none_of(recent_, is_met));
}

double PassedObstacles::nearest_m() const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto* points : {&hidden_, &visible_}) {
    for (const Point& point : *points) nearest_m = std::min(nearest_m, (point.p_WP - p_WC_).norm());
  }
  return nearest_m;
}

std::vector<Eigen::Vector3d> PassedObstacles::points_W() const {
  std::vector<Eigen::Vector3d> points;
  for (const Point& point : hidden_) points.push_back(point.p_WP);
  return points;
}

}  // namespace hedgehop::avoidance::stereo
