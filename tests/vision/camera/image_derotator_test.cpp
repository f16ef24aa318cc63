#include "vision/camera/image_derotator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <variant>

#include "tests/vision/corridor/corridor_world.h"

namespace hedgehop::vision::camera {
namespace {

TEST(ImageDerotator, SourcePixelsAreThoseOfTheRotatedRays) {
  constexpr double kFloatPx = 1e-4;
  for (const Camera& camera : {whole_fisheye(), whole_fisheye(161, 120)}) {
    cv::Mat wanted(camera.height_px, camera.width_px, CV_8UC1, cv::Scalar(0));
    wanted(cv::Rect(17, 5, camera.width_px - 21, camera.height_px - 6)).setTo(255);
    const ImageDerotator derotator(camera, wanted);
    const double focal_px = std::get<FisheyeLens>(camera.lens).focal_x_px;
    for (const double turn_rad : {0.0, 0.03, 0.1, 0.3}) {
      double worst_px = 0.0;
      const Eigen::Matrix3d R_C1C2 =
          Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(0.6, -0.5, 0.7).normalized()).toRotationMatrix();
      const cv::Mat places = derotator.source_pixels(R_C1C2);
      ASSERT_EQ(places.size(), derotator.box().size());
      for (int row = 0; row < places.rows; ++row) {
        for (int col = 0; col < places.cols; ++col) {
          const auto found = places.at<cv::Vec2f>(row, col);
          const auto ray_C1 = camera.unit_ray({derotator.box().x + col, derotator.box().y + row});
          const auto expected = ray_C1 ? camera.project(R_C1C2.transpose() * *ray_C1) : std::nullopt;
          ASSERT_EQ(found[0] > -50.0F, expected.has_value()) << row << " " << col;
          if (expected) {
            worst_px = std::max(worst_px, (*expected - Eigen::Vector2d(found[0], found[1])).norm());
          }
        }
      }
      // Linear between every fourth row and column: 4^2 / 8 px^2 in both directions, times a curvature proportional to
      // the rotation.
      EXPECT_LT(worst_px, 4.0 * turn_rad / focal_px + kFloatPx) << camera.width_px;
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::camera
