#include "avoidance/section_grid/seen_space.h"

#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::section_grid {
namespace {

/// Age at which an image is forgotten: by then the position estimate has drifted by about the radius of the vehicle.
constexpr double kKeepS = 12.0;
/// Minimum time between two remembered images: at 5 mph, 0.9 m of flight.
constexpr double kEveryS = 0.4;
/// Minimum depth in front of a camera at which a point counts as in view, m.
constexpr double kNearestM = 0.3;
/// Disparity error that a free point must allow for, x 16: half a pixel.
constexpr double kNoise16 = 8.0;

}  // namespace

void SeenSpace::update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid,
                       const vision::stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC) {
  geometry_ = geometry;
  image_ = pyramid.image();
  while (!images_.empty() && seconds(t_ns - images_.front().t_ns) > kKeepS) images_.pop_front();
  // The newest image is always available. It stays only if the interval to the image before it is long enough.
  const size_t n = images_.size();
  if (n >= 2 && seconds(images_[n - 1].t_ns - images_[n - 2].t_ns) < kEveryS) images_.pop_back();
  images_.push_back({t_ns, X_WC.inverse(), pyramid.level(kBlockLevel).clone()});
}

bool SeenSpace::free(const Eigen::Vector3d& p_W) const {
  for (auto image = images_.rbegin(); image != images_.rend(); ++image) {
    const Eigen::Vector3d p_C = image->X_CW * p_W;
    if (p_C.z() < kNearestM) continue;
    const double u = geometry_.center_u_px + geometry_.focal_px * p_C.x() / p_C.z();
    const double v = geometry_.center_v_px + geometry_.focal_px * p_C.y() / p_C.z();
    if (u < 0.0 || u > image_.width - 1 || v < 0.0 || v > image_.height - 1) continue;
    const int col = static_cast<int>(u) >> kBlockLevel, row = static_cast<int>(v) >> kBlockLevel;
    return image->nearest16.at<int16_t>(row, col) + kNoise16 < geometry_.disparity16(p_C.z());
  }
  return false;
}

bool SeenSpace::free_path(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, double radius_m) const {
  constexpr double kStepM = 0.5;
  const Eigen::Vector3d path_W = to_W - from_W;
  const Eigen::Vector3d ahead_W = path_W.normalized();
  const Eigen::Vector3d aside_W = ahead_W.unitOrthogonal(), across_W = ahead_W.cross(aside_W);
  for (double along_m = kStepM; along_m <= path_W.norm(); along_m += kStepM) {
    const Eigen::Vector3d p_W = from_W + along_m * ahead_W;
    constexpr int kAround = 8;
    if (!free(p_W)) return false;
    for (int i = 0; i < kAround; ++i) {
      const double angle_rad = 2.0 * M_PI * i / kAround;
      if (!free(p_W + radius_m * (std::cos(angle_rad) * aside_W + std::sin(angle_rad) * across_W))) return false;
    }
  }
  return true;
}

}  // namespace hedgehop::avoidance::section_grid
