#include "sim/loop/corner_detector.h"

#include <utility>

namespace hedgehop::sim {

ProjectedCorners::ProjectedCorners(std::vector<Eigen::Vector3d> corners_W, uint64_t seed)
    : corners_W_(std::move(corners_W)), random_(seed) {}

std::vector<Eigen::Vector2d> ProjectedCorners::project(const vision::camera::Camera& camera,
                                                       const Eigen::Isometry3d& X_WC) {
  constexpr double kNoisePx = 0.5;  // of a corner detector that works well
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& p_W : corners_W_) {
    const auto pixel = camera.project(X_WC.inverse() * p_W);
    const bool in_image = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera.width_px - 1 &&
                          pixel->y() <= camera.height_px - 1;
    if (!in_image) continue;
    const double right_px = kNoisePx * normal_(random_), down_px = kNoisePx * normal_(random_);
    pixels.push_back(*pixel + Eigen::Vector2d(right_px, down_px));
  }
  return pixels;
}

}  // namespace hedgehop::sim
