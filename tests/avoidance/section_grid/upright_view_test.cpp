#include "avoidance/section_grid/upright_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance::section_grid {
namespace {

/// A camera that looks ahead, rolled about its axis; its image is not square and its principal point off the middle.
SectionCamera rolled(double roll_rad) {
  SectionCamera camera{{50.0, 30.0, 22.0, 0.12}, Eigen::Isometry3d::Identity(), {64, 40}};
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  camera.X_BC.linear().col(0) = Eigen::Vector3d(0.0, c, s);
  camera.X_BC.linear().col(1) = Eigen::Vector3d(0.0, -s, c);
  camera.X_BC.linear().col(2) = Eigen::Vector3d(1.0, 0.0, 0.0);
  return camera;
}

cv::Point pixel_of(const Eigen::Vector3d& p_B, const SectionCamera& camera) {
  const Eigen::Vector3d p_C = camera.X_BC.inverse() * p_B;
  const vision::stereo::StereoGeometry& g = camera.geometry;
  return {static_cast<int>(std::lround(g.center_u_px + g.focal_px * p_C.x() / p_C.z())),
          static_cast<int>(std::lround(g.center_v_px + g.focal_px * p_C.y() / p_C.z()))};
}

// A point of the body is drawn by the mounted camera. After the turn it must be at its pixel of the upright camera.
TEST(UprightView, PointOfTheBodyIsAtThePixelOfTheUprightCamera) {
  const Eigen::Vector3d p_B(10.0, 1.0, 1.6);  // ahead, to the right and below
  for (const double roll_deg : {0.0, 20.0, 90.0, 110.0, 180.0, -90.0, -70.0}) {
    const SectionCamera mounted = rolled(roll_deg * M_PI / 180.0);
    cv::Mat image(mounted.image, CV_32FC1, cv::Scalar(0.0)), upright;
    image.at<float>(pixel_of(p_B, mounted)) = 1.0F;
    const UprightView view(mounted);
    view.rotate(image, upright);
    ASSERT_EQ(upright.size(), view.camera().image) << roll_deg;
    EXPECT_EQ(upright.at<float>(pixel_of(p_B, view.camera())), 1.0F) << roll_deg;
    EXPECT_GT(view.camera().X_BC.linear()(2, 1), std::cos(0.26 * M_PI)) << roll_deg << ": v points down";
  }
}

TEST(UprightView, UprightCameraKeepsItsImages) {
  const UprightView view(rolled(0.0));
  const cv::Mat image(40, 64, CV_32FC1, cv::Scalar(3.0));
  cv::Mat upright;
  view.rotate(image, upright);
  EXPECT_EQ(upright.data, image.data);
  EXPECT_EQ(view.camera().geometry.center_u_px, 30.0);
  EXPECT_EQ(view.camera().X_BC.matrix(), rolled(0.0).X_BC.matrix());
}

}  // namespace
}  // namespace hedgehop::avoidance::section_grid
