#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/vision/flow/textured_image.h"
#include "vision/camera/camera.h"

/// A straight corridor along north and its image in a fisheye below a vehicle, drawn ray by ray.
namespace hedgehop::vision {

/// A field of view of 190 degrees, with the complete circle in the image.
inline camera::Camera whole_fisheye(int width_px = 752, int height_px = 480) {
  camera::FisheyeLens lens;
  lens.limit_rad = 95.0 * std::numbers::pi / 180.0;
  lens.focal_x_px = lens.focal_y_px = 0.5 * height_px / lens.limit_rad;
  lens.center_u_px = 0.5 * (width_px - 1);
  lens.center_v_px = 0.5 * (height_px - 1);
  return {width_px, height_px, lens};
}

/// Looks down, the nose up in the image: C's x is B's y, C's y is -B's x.
inline Eigen::Isometry3d looking_down() {
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear().col(0) = Eigen::Vector3d::UnitY();
  X_BC.linear().col(1) = -Eigen::Vector3d::UnitX();
  X_BC.linear().col(2) = Eigen::Vector3d::UnitZ();
  return X_BC;
}

/// Walls at east -left_m and right_m, floor at altitude 0, ceiling; an end wall at north end_m.
struct StraightCorridor {
  double left_m = 1.25, right_m = 1.25, ceiling_m = 3.0, end_m = std::numeric_limits<double>::infinity();

  std::vector<TexturedPlane> planes() const {
    using Eigen::Vector3d;
    std::vector<TexturedPlane> all = {{{0, -left_m, 0}, Vector3d::UnitX(), Vector3d::UnitZ()},
                                      {{0, right_m, 0}, Vector3d::UnitX(), Vector3d::UnitZ()},
                                      {{0, 0, 0}, Vector3d::UnitX(), Vector3d::UnitY()},
                                      {{0, 0, -ceiling_m}, Vector3d::UnitX(), Vector3d::UnitY()}};
    if (std::isfinite(end_m)) all.push_back({{end_m, 0, 0}, Vector3d::UnitY(), Vector3d::UnitZ()});
    return all;
  }

  /// Returns the length of a ray from a point to the corridor, m. @param ray_W  unit vector.
  double range_m(const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const TexturedPlane& plane : planes()) {
      const Eigen::Vector3d normal = plane.s_W.cross(plane.t_W);
      const double range = normal.dot(plane.p_WO - p_W) / normal.dot(ray_W);
      if (range > 0.0) nearest_m = std::min(nearest_m, range);
    }
    return nearest_m;
  }
};

/// Draws textured planes through any lens, like draw_planes() for pinholes; black outside the image circle.
/// Texture too fine for the image at that range is averaged over `oversample` squared points in each pixel.
inline cv::Mat draw_planes_through(const camera::Camera& camera, const Eigen::Isometry3d& X_WC,
                                   const std::vector<TexturedPlane>& planes, const WaveTexture& texture,
                                   int oversample = 1) {
  const auto seen = [&](const Eigen::Vector2d& pixel) {
    const auto ray_C = camera.unit_ray(pixel);
    if (!ray_C) return 0.0;
    const auto point = seen_point(X_WC.translation(), X_WC.linear() * *ray_C, planes);
    return point ? texture.grey(point->x(), point->y()) : 0.0;
  };
  return draw_image(camera.width_px, camera.height_px, [&](double u, double v) {
    double sum = 0.0;
    for (int i = 0; i < oversample; ++i) {
      for (int j = 0; j < oversample; ++j) {
        sum += seen({u + (i + 0.5) / oversample - 0.5, v + (j + 0.5) / oversample - 0.5});
      }
    }
    return sum / (oversample * oversample);
  });
}

}  // namespace hedgehop::vision
