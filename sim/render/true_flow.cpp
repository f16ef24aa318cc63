#include "sim/render/true_flow.h"

#include <cmath>
#include <limits>

#include "sim/render/lens_faces.h"

namespace hedgehop::sim {

std::vector<Eigen::Vector3d> all_rays(const vision::camera::Camera& camera) {
  const Eigen::Vector3d nothing = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Eigen::Vector3d> rays;
  rays.reserve(static_cast<size_t>(camera.width_px) * static_cast<size_t>(camera.height_px));
  for (int row = 0; row < camera.height_px; ++row) {
    for (int col = 0; col < camera.width_px; ++col) {
      rays.push_back(camera.ray(Eigen::Vector2d(col, row)).value_or(nothing));
    }
  }
  return rays;
}

void true_flow(const vision::camera::Camera& camera, const std::vector<Eigen::Vector3d>& rays, const FlowInput& input,
               cv::Mat& out) {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  out.create(camera.height_px, camera.width_px, CV_32FC2);
  const Eigen::Isometry3d X_CnC = input.X_WC_next.inverse() * input.X_WC;  // Cn: C at the next image
  const Eigen::Matrix3d R_CnW = input.X_WC_next.linear().transpose();
  const bool z = depth_is_z(camera);
  auto ray = rays.begin();
  for (int row = 0; row < out.rows; ++row) {
    for (int col = 0; col < out.cols; ++col, ++ray) {
      cv::Vec2f& flow = out.at<cv::Vec2f>(row, col);
      flow = {kNothing, kNothing};
      if (!ray->allFinite()) continue;
      const auto depth_m = static_cast<double>(input.depth.at<float>(row, col));
      Eigen::Vector3d p_Cn = X_CnC.linear() * *ray;
      if (std::isfinite(depth_m)) {
        p_Cn = X_CnC * Eigen::Vector3d(*ray * (z ? depth_m / ray->z() : depth_m));
        const int mover = input.labels.at<int>(row, col) - input.first_mover_label;
        if (mover >= 0) p_Cn += R_CnW * input.moved_W_m[static_cast<size_t>(mover)];
      }
      if (const auto pixel = camera.project(p_Cn)) {
        flow = {static_cast<float>(pixel->x() - col), static_cast<float>(pixel->y() - row)};
      }
    }
  }
}

}  // namespace hedgehop::sim
