#include "sim/render/true_flow.h"

#include <cmath>
#include <limits>

#include "sim/render/lens_faces.h"

namespace hedgehop::sim {

namespace {

/// Returns the index of the moving obstacle at a pixel; negative if there is none.
int mover_at(const FlowInput& input, int row, int col) {
  return input.moved_W.empty() ? -1 : input.labels.at<int>(row, col) - input.first_mover_label;
}

}  // namespace

Eigen::Vector3d displacement(const Eigen::Isometry3d& moved_W, const Eigen::Vector3d& p_W) {
  return moved_W.translation() + (moved_W.linear() - Eigen::Matrix3d::Identity()) * p_W;
}

std::vector<Eigen::Vector3d> all_rays(const vision::camera::Camera& camera) {
  const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Eigen::Vector3d> rays;
  rays.reserve(static_cast<size_t>(camera.width_px) * static_cast<size_t>(camera.height_px));
  for (int row = 0; row < camera.height_px; ++row) {
    for (int col = 0; col < camera.width_px; ++col) {
      rays.push_back(camera.unit_ray(Eigen::Vector2d(col, row)).value_or(unknown));
    }
  }
  return rays;
}

void true_flow(const vision::camera::Camera& camera, const std::vector<Eigen::Vector3d>& rays, const FlowInput& input,
               cv::Mat& out) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  out.create(camera.height_px, camera.width_px, CV_32FC2);
  const Eigen::Isometry3d X_CnC = input.X_WC_next.inverse() * input.X_WC;  // Cn: C at the next image
  const Eigen::Matrix3d R_CnW = input.X_WC_next.linear().transpose();
  const bool z = depth_is_z(camera);
  auto ray = rays.begin();
  for (int row = 0; row < out.rows; ++row) {
    for (int col = 0; col < out.cols; ++col, ++ray) {
      cv::Vec2f& flow = out.at<cv::Vec2f>(row, col);
      flow = {kUnknown, kUnknown};
      if (!ray->allFinite()) continue;
      const auto depth_m = static_cast<double>(input.depth.at<float>(row, col));
      Eigen::Vector3d p_Cn = X_CnC.linear() * *ray;
      if (std::isfinite(depth_m)) {
        const Eigen::Vector3d p_C = *ray * (z ? depth_m / ray->z() : depth_m);
        p_Cn = X_CnC * p_C;
        if (const int mover = mover_at(input, row, col); mover >= 0)
          p_Cn += R_CnW * displacement(input.moved_W[static_cast<size_t>(mover)], input.X_WC * p_C);
      }
      if (const auto pixel = camera.project(p_Cn)) {
        flow = {static_cast<float>(pixel->x() - col), static_cast<float>(pixel->y() - row)};
      }
    }
  }
}

void true_flow(const vision::camera::PinholeCamera& camera, const FlowInput& input, cv::Mat& out) {
  out.create(camera.height_px, camera.width_px, CV_32FC2);
  // Maps points of C at this image to those of Cn, C at the next image, for one moving obstacle or the rest.
  struct NextPoints {
    Eigen::Matrix3d R;
    Eigen::Vector3d t, right;
  };
  const auto next_points = [&](const Eigen::Matrix3d& R, const Eigen::Vector3d& t) -> NextPoints {
    return {R, t, R.col(0) / camera.focal_x_px};
  };
  const Eigen::Isometry3d X_CnC = input.X_WC_next.inverse() * input.X_WC;
  const Eigen::Matrix3d R_CnW = input.X_WC_next.linear().transpose();
  const NextPoints still = next_points(X_CnC.linear(), X_CnC.translation());
  std::vector<NextPoints> moving;
  for (const Eigen::Isometry3d& moved_W : input.moved_W) {
    moving.push_back(next_points(R_CnW * (moved_W.linear() * input.X_WC.linear()),
                                 X_CnC.translation() + R_CnW * displacement(moved_W, input.X_WC.translation())));
  }
  // `first`: the point at z = 1 in the first column of the row. Sky has 1 / z = 0.
  const auto flow_at = [&](const Eigen::Vector3d& first, int col, double per_z, const NextPoints& next) {
    const double x = first.x() + next.right.x() * col + next.t.x() * per_z;
    const double y = first.y() + next.right.y() * col + next.t.y() * per_z;
    const double z = first.z() + next.right.z() * col + next.t.z() * per_z;
    const double per_z_next = 1.0 / z;
    const double u = camera.focal_x_px * x * per_z_next + camera.center_u_px;
    const double v = camera.focal_y_px * y * per_z_next + camera.center_v_px;
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return z > 0.0 ? Eigen::Vector2d(u, v) : Eigen::Vector2d(kUnknown, kUnknown);
  };
  for (int row = 0; row < out.rows; ++row) {
    const float* const depth = input.depth.ptr<float>(row);
    cv::Vec2f* const flow = out.ptr<cv::Vec2f>(row);
    const Eigen::Vector3d ray = camera.ray_at_unit_depth({0.0, row});
    const auto put = [&](int col, const Eigen::Vector3d& first, const NextPoints& next) {
      const Eigen::Vector2d seen = flow_at(first, col, 1.0 / static_cast<double>(depth[col]), next);
      flow[col] = {static_cast<float>(seen.x() - col), static_cast<float>(seen.y() - row)};
    };
    const Eigen::Vector3d first = still.R * ray;
    for (int col = 0; col < out.cols; ++col) put(col, first, still);
    if (moving.empty()) continue;
    for (int col = 0; col < out.cols; ++col) {
      const int mover = mover_at(input, row, col);
      if (mover < 0) continue;
      const NextPoints& next = moving[static_cast<size_t>(mover)];
      put(col, next.R * ray, next);
    }
  }
}

}  // namespace hedgehop::sim
