#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "tests/vision/camera/random_lenses.h"

// Rational, unified and double-sphere lenses against implementations that are not Hedgehop's.
namespace hedgehop::vision::camera {
namespace {

using Points = std::vector<cv::Point3d>;

constexpr double kOutsidePx = 1e-9;
constexpr double kBackPx = 1e-6;  // the limit of the iteration that inverts a lens

/// Returns the pixels of points by OpenCV, with 8 coefficients.
std::vector<cv::Point2d> pixels_of_opencv(const PinholeLens& lens, const Points& points_C) {
  const cv::Matx33d K(lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1);
  const std::vector<double> D = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points_C, cv::Vec3d(), cv::Vec3d(), K, D, pixels);
  return pixels;
}

/// Returns the pixels of points by OpenCV, or by the construction of the double sphere: a point is projected onto one
/// unit sphere, then onto a second one xi behind it, then from alpha / (1 - alpha) behind that onto the image.
std::vector<cv::Point2d> pixels_outside(const Camera& camera, const Points& points_C) {
  if (const auto* const plane = std::get_if<PinholeLens>(&camera.lens)) return pixels_of_opencv(*plane, points_C);
  if (const auto* const unified = std::get_if<UnifiedLens>(&camera.lens)) {
    Points moved;  // the unified lens is a pinhole that sees the unit sphere from xi behind its center
    for (const cv::Point3d& p : points_C) moved.push_back(p / cv::norm(p) + cv::Point3d(0.0, 0.0, unified->xi));
    return pixels_of_opencv(unified->plane, moved);
  }
  const auto& lens = std::get<DoubleSphereLens>(camera.lens);
  std::vector<cv::Point2d> pixels;
  for (const cv::Point3d& p : points_C) {
    const cv::Point3d on_first = p / cv::norm(p) + cv::Point3d(0.0, 0.0, lens.xi);
    const cv::Point3d on_second = on_first / cv::norm(on_first);
    const double depth = (1.0 - lens.alpha) * on_second.z + lens.alpha;
    pixels.emplace_back(lens.center_u_px + lens.focal_x_px * on_second.x / depth,
                        lens.center_v_px + lens.focal_y_px * on_second.y / depth);
  }
  return pixels;
}

std::vector<Camera> random_cameras(std::mt19937_64& random) {
  return {random_rational_pinhole(random), random_unified(random), random_double_sphere(random)};
}

TEST(OutsideLenses, ProjectPointsToTheSamePixels) {
  std::mt19937_64 random(106);
  size_t compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    for (const Camera& camera : random_cameras(random)) {
      Points points_C;
      while (points_C.size() < 100) {
        const double z_m = uniform(random, 0.1, 50.0);
        points_C.emplace_back(z_m * uniform(random, -0.7, 0.7), z_m * uniform(random, -0.6, 0.6), z_m);
      }
      const std::vector<cv::Point2d> expected = pixels_outside(camera, points_C);
      for (size_t i = 0; i < points_C.size(); ++i) {
        const auto pixel = camera.project({points_C[i].x, points_C[i].y, points_C[i].z});
        if (!pixel) continue;
        ++compared;
        ASSERT_NEAR(pixel->x(), expected[i].x, kOutsidePx) << camera.lens_name();
        ASSERT_NEAR(pixel->y(), expected[i].y, kOutsidePx) << camera.lens_name();
      }
    }
  }
  EXPECT_GT(compared, 10'000u);
}

TEST(OutsideLenses, ProjectTheRayOfEveryPixelBackToIt) {
  std::mt19937_64 random(108);
  for (int trial = 0; trial < 6; ++trial) {
    for (const Camera& camera : random_cameras(random)) {
      Points rays_C;
      std::vector<cv::Point2d> pixels;
      for (int row = 0; row < camera.height_px; ++row) {
        for (int col = 0; col < camera.width_px; ++col) {
          const auto ray = camera.unit_ray({col, row});
          if (!ray) continue;
          rays_C.emplace_back(ray->x(), ray->y(), ray->z());
          pixels.emplace_back(col, row);
        }
      }
      const std::vector<cv::Point2d> back = pixels_outside(camera, rays_C);
      double worst_px = 0.0;
      for (size_t i = 0; i < pixels.size(); ++i) worst_px = std::max(worst_px, cv::norm(back[i] - pixels[i]));
      EXPECT_LT(worst_px, kBackPx) << camera.lens_name() << ", trial " << trial;
      // Others are past the turn of a polynomial, which is reported, or outside the image circle of a double sphere.
      const bool has_circle = std::holds_alternative<DoubleSphereLens>(camera.lens);
      const double shown = static_cast<double>(pixels.size()) / (camera.width_px * camera.height_px);
      EXPECT_GE(shown, has_circle ? 0.5 : 1.0 - share_past_turn(camera) - 0.005) << camera.lens_name();
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::camera
