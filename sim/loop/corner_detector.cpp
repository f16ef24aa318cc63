#include "sim/loop/corner_detector.h"

#include <utility>

namespace hedgehop::sim {

CornerDetector::CornerDetector(std::vector<Eigen::Vector3d> corners_W, double noise_px, uint64_t seed)
    : corners_W_(std::move(corners_W)), noise_px_(noise_px), noise_(seed) {}

cv::Mat CornerDetector::detect(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC) {
  cv::Mat detected = nothing();
  for (const Eigen::Vector3d& p_W : corners_W_) {
    const auto pixel = camera.project(X_WC.inverse() * p_W);
    const bool in_image = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera.width_px - 1 &&
                          pixel->y() <= camera.height_px - 1;
    if (!in_image) continue;
    const double right_px = noise_px_ * noise_.normal(), down_px = noise_px_ * noise_.normal();
    detected.push_back(cv::Vec2d(pixel->x() + right_px, pixel->y() + down_px));
  }
  return detected;
}

}  // namespace hedgehop::sim
