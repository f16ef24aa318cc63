#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/spot_image.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

constexpr double kSubPixel =
    0.05;  // about ten times the error from 8-bit levels and the 1/256 px grid of the rasterizer

vision::camera::PinholeCamera random_camera(std::mt19937_64& random) {
  const int width = 100 + static_cast<int>(random() % 300), height = 100 + static_cast<int>(random() % 300);
  return {width,
          height,
          uniform(random, 80, 500),
          uniform(random, 80, 500),
          width * uniform(random, 0.3, 0.7),
          height * uniform(random, 0.3, 0.7)};
}

/// Returns the expected pixel of a point in W, written out: the axes of C are the columns of R_WC.
Eigen::Vector2d expected_pixel(const CameraView& view, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d from_eye_W = p_W - view.X_WC.translation();
  const double x = from_eye_W.dot(view.X_WC.linear().col(0)), y = from_eye_W.dot(view.X_WC.linear().col(1));
  const double z = from_eye_W.dot(view.X_WC.linear().col(2));
  const vision::camera::PinholeCamera camera = view.camera.pinhole();
  return {camera.focal_x_px * x / z + camera.center_u_px, camera.focal_y_px * y / z + camera.center_v_px};
}

// The centroid of a spot parallel to the image plane is the projection of its center, for any lens and pose.
TEST(Projection, DrawsPointsAtTheirExpectedPixels) {
  std::mt19937_64 random(11);
  cv::Mat grey;
  double sum_squares = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    CameraView view{random_camera(random), random_pose(random, 800.0, 100.0, 1.5), ImageChannel::grey};
    const double z_m = std::exp(uniform(random, std::log(0.5), std::log(200.0)));
    const Eigen::Vector2d pixel(uniform(random, 30, view.camera.width_px - 30),
                                uniform(random, 30, view.camera.height_px - 30));
    const Eigen::Vector3d center_W = view.X_WC * Eigen::Vector3d(z_m * view.camera.pinhole().ray_at_unit_depth(pixel));
    const double width_m = 40.0 * z_m / view.camera.pinhole().focal_x_px,
                 height_m = 40.0 * z_m / view.camera.pinhole().focal_y_px;
    const Eigen::Vector3d right_W = width_m * view.X_WC.linear().col(0), down_W = height_m * view.X_WC.linear().col(1);

    SmallWorld world(std::vector{spot_image(64)});
    world.scene.sky = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
    world.scene.lights = {.ambient = 1.0f, .sun = 0.0f};
    const Eigen::Vector3d top_left_W = center_W - 0.5 * (right_W + down_W);
    world.add_quad(top_left_W.cast<float>(), right_W.cast<float>(), down_W.cast<float>());
    make_renderer(world.scene).draw(view, grey);

    const double error_px = (centroid(grey) - expected_pixel(view, center_W)).norm();
    EXPECT_LT(error_px, kSubPixel) << "trial " << trial << ", z " << z_m;
    sum_squares += error_px * error_px;
  }
  RecordProperty("rms_px", std::to_string(std::sqrt(sum_squares / 60)));
}

// North-east-down, camera to the north: east is right, up is up, and the first row of a texture is the top row.
TEST(Projection, DoesNotMirrorImages) {
  cv::Mat quadrants(64, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  quadrants(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(250, 0, 0));
  quadrants(cv::Rect(32, 0, 32, 32)).setTo(cv::Scalar(0, 250, 0));
  quadrants(cv::Rect(0, 32, 32, 32)).setTo(cv::Scalar(0, 0, 250));
  SmallWorld world(std::vector{quadrants});
  world.scene.lights = {.ambient = 1.0f, .sun = 0.0f};
  world.add_box({Eigen::Vector3f(10, -2, -7), Eigen::Vector3f(14, 2, -3)});
  Renderer renderer = make_renderer(world.scene);
  const auto camera = vision::camera::PinholeCamera::from_fov(100, 100, 0.5);
  cv::Mat image;
  for (const Eigen::Vector3d& side : {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                      Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1)}) {
    const Eigen::Vector3d center_W(12, 0, -5);
    renderer.draw({camera, look_at(center_W + 12.0 * side, center_W), ImageChannel::color}, image);
    EXPECT_EQ(image.at<cv::Vec3b>(40, 40), cv::Vec3b(250, 0, 0)) << side.transpose();
    EXPECT_EQ(image.at<cv::Vec3b>(40, 60), cv::Vec3b(0, 250, 0)) << side.transpose();
    EXPECT_EQ(image.at<cv::Vec3b>(60, 40), cv::Vec3b(0, 0, 250)) << side.transpose();
    EXPECT_EQ(image.at<cv::Vec3b>(60, 60), cv::Vec3b(0, 0, 0)) << side.transpose();
  }
}

TEST(Projection, ShowsFrontFacesOnly) {
  SmallWorld world;
  world.add_box({Eigen::Vector3f(-5, -5, -10), Eigen::Vector3f(5, 5, 0)});
  Renderer renderer = make_renderer(world.scene);
  cv::Mat inside, outside;
  const auto camera = vision::camera::PinholeCamera::from_fov(64, 48, 1.2);
  renderer.draw({camera, look_at({0, 0, -5}, {1, 0.2, -5}), ImageChannel::depth}, inside);
  renderer.draw({camera, look_at({-9, 0, -5}, {0, 0, -5}), ImageChannel::depth}, outside);
  EXPECT_EQ(cv::countNonZero(inside == std::numeric_limits<float>::infinity()), inside.rows * inside.cols);
  EXPECT_NEAR(outside.at<float>(24, 32), 4.0, 1e-4);
}

}  // namespace
}  // namespace hedgehop::sim
