#include "vision/camera/pinhole_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace hedgehop::vision::camera {
namespace {

using std::numbers::pi;

TEST(PinholeCamera, NinetyDegreesAcross400PixelsIsAFocalLengthOf200) {
  const auto camera = PinholeCamera::from_fov(400, 300, pi / 2);
  EXPECT_NEAR(camera.focal_x_px, 200.0, 1e-12);
  EXPECT_NEAR(camera.focal_y_px, 200.0, 1e-12);
  EXPECT_EQ(camera.center_u_px, 199.5);
  EXPECT_EQ(camera.center_v_px, 149.5);
}

TEST(PinholeCamera, ImageBordersAreAtHalfTheFieldOfView) {
  const auto camera = PinholeCamera::from_fov(641, 480, 1.1);
  const auto left = camera.ray_at_unit_depth({-0.5, camera.center_v_px});
  const auto right = camera.ray_at_unit_depth({640.5, camera.center_v_px});
  EXPECT_NEAR(std::atan(right.x()), 0.55, 1e-12);
  EXPECT_NEAR(std::atan(left.x()), -0.55, 1e-12);
}

TEST(PinholeCamera, ProjectionInvertsRay) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> pixel(-50.0, 450.0), depth(0.1, 100.0);
  const auto camera = PinholeCamera::from_fov(400, 300, 1.2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d p{pixel(random), pixel(random)};
    const auto q = camera.project(depth(random) * camera.ray_at_unit_depth(p));
    ASSERT_TRUE(q);
    EXPECT_LT((*q - p).norm(), 1e-10);
  }
}

TEST(PinholeCamera, RightAndDownInFrontOfTheCameraAreRightAndDownInTheImage) {
  const auto camera = PinholeCamera::from_fov(400, 400, pi / 2);
  const auto right = camera.project({1.0, 0.0, 2.0});
  const auto down = camera.project({0.0, 1.0, 2.0});
  ASSERT_TRUE(right && down);
  EXPECT_NEAR(right->x(), 199.5 + 100.0, 1e-12);
  EXPECT_NEAR(down->y(), 199.5 + 100.0, 1e-12);
}

TEST(PinholeCamera, PointsBehindTheCameraAreInvisible) {
  const auto camera = PinholeCamera::from_fov(400, 400, pi / 2);
  EXPECT_FALSE(camera.project({1.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.project({0.0, 0.0, std::nan("")}));
}

TEST(PinholeCamera, RejectsInvalidSizesAndFieldsOfView) {
  EXPECT_THROW(PinholeCamera::from_fov(0, 10, 1.0), std::invalid_argument);
  EXPECT_THROW(PinholeCamera::from_fov(10, -1, 1.0), std::invalid_argument);
  EXPECT_THROW(PinholeCamera::from_fov(10, 10, 0.0), std::invalid_argument);
  EXPECT_THROW(PinholeCamera::from_fov(10, 10, pi), std::invalid_argument);
  EXPECT_THROW(PinholeCamera::from_fov(10, 10, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::vision::camera
