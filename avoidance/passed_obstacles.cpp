#include "avoidance/passed_obstacles.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance {

void PassedObstacles::update(int64_t t_ns, const vision::DepthPyramid& pyramid, const vision::StereoGeometry& geometry,
                             const Eigen::Isometry3d& X_WC) {
  if (config_.radius_m == 0.0) return;
  p_WC_ = X_WC.translation();
  t_ns_ = t_ns;
  const Eigen::Isometry3d X_CW = X_WC.inverse();
  constexpr int kLevel = 3;
  const int level = std::min(kLevel, pyramid.top()), size = 1 << level;
  hidden_.insert(hidden_.end(), visible_.begin(), visible_.end());
  std::erase_if(hidden_, [&](const Point& point) {
    const Eigen::Vector3d p_CP = X_CW * point.p_WP;
    const double age_s = 1e-9 * static_cast<double>(t_ns - point.t_ns);
    const auto shows = [&](double right_m, double down_m) {
      return in_view(p_CP + Eigen::Vector3d(right_m, down_m, 0.0), pyramid, geometry);
    };
    // What may have moved is forgotten once the whole block would be in view wherever it may be.
    const double half_block_m = 0.5 * size * p_CP.z() / geometry.focal_px;
    const double moved_m = config_.moves_mps > 0.0 ? config_.moves_mps * age_s + half_block_m : 0.0;
    return age_s > config_.keep_s || p_CP.norm() > config_.near_m ||
           (shows(moved_m, 0.0) && shows(-moved_m, 0.0) && shows(0.0, moved_m) && shows(0.0, -moved_m));
  });

  // The nearest point of each block stands for it.
  const double near16 = geometry.disparity16(config_.near_m);
  visible_.clear();
  for (int row = 0; row < pyramid.level(level).rows; ++row) {
    for (int col = 0; col < pyramid.level(level).cols; ++col) {
      const int d = pyramid.disparity16(level, row, col);
      if (d < near16) continue;
      const cv::Point centre(col * size + size / 2, row * size + size / 2);
      visible_.push_back({X_WC * (geometry.z_m(d) * geometry.ray(centre)), t_ns});
    }
  }
}

bool PassedObstacles::in_view(const Eigen::Vector3d& p_CP, const vision::DepthPyramid& pyramid,
                              const vision::StereoGeometry& geometry) const {
  if (!(p_CP.z() > 0.0)) return false;
  const double u = geometry.center_u_px + geometry.focal_px * p_CP.x() / p_CP.z();
  const double v = geometry.center_v_px + geometry.focal_px * p_CP.y() / p_CP.z();
  // Left of its own disparity a point is out of the right camera's view.
  const double first_u = geometry.focal_px * geometry.baseline_m / p_CP.z();
  const cv::Size picture = pyramid.picture();
  return u >= first_u && u <= picture.width - 1 && v >= 0 && v <= picture.height - 1;
}

bool PassedObstacles::free(const Eigen::Vector3d& direction_W) const {
  constexpr double kNoCloser = 0.9;
  const Eigen::Vector3d ahead = direction_W.normalized();
  return std::ranges::none_of(hidden_, [&](const Point& point) {
    const Eigen::Vector3d p = point.p_WP - p_WC_;
    const double along_m = p.dot(ahead);
    const double radius_m = config_.radius_m + config_.moves_mps * 1e-9 * static_cast<double>(t_ns_ - point.t_ns);
    const double aside_m = std::min(radius_m, kNoCloser * p.norm());
    return along_m > 0.0 && p.squaredNorm() - along_m * along_m < aside_m * aside_m;
  });
}

std::vector<Eigen::Vector3d> PassedObstacles::points_W() const {
  std::vector<Eigen::Vector3d> points;
  for (const Point& point : hidden_) points.push_back(point.p_WP);
  return points;
}

}  // namespace hedgehop::avoidance
