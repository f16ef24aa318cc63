#include "sim/loop/corner_detector.h"

#include <utility>

#include "sim/verdict/corner_sight.h"

namespace hedgehop::sim {

CornerDetector::CornerDetector(std::vector<Eigen::Vector3d> corners_W, double noise_px, uint64_t seed)
    : corners_W_(std::move(corners_W)), noise_px_(noise_px), random_(seed) {}

cv::Mat CornerDetector::detect(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC) {
  const std::vector<bool> in_image = corners_in_sight(corners_W_, camera, X_WC, /*world=*/nullptr, /*t_s=*/0.0);
  cv::Mat detected = nothing();
  for (size_t i = 0; i < corners_W_.size(); ++i) {
    if (!in_image[i]) continue;
    const double right_px = noise_px_ * normal_(random_), down_px = noise_px_ * normal_(random_);
    const Eigen::Vector2d pixel = *camera.project(X_WC.inverse() * corners_W_[i]) + Eigen::Vector2d(right_px, down_px);
    detected.push_back(cv::Vec2d(pixel.x(), pixel.y()));
  }
  return detected;
}

}  // namespace hedgehop::sim
