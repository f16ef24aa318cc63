#include "sim/loop/corner_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/worlds/highrise.h"
#include "sim/reproduce/corner_flight.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

const scenes::worlds::HighriseConfig kCube{.layout = scenes::worlds::HighriseConfig::Layout::cube};

TEST(ProjectedCorners, ScatterByHalfAPixelRoundTheProjections) {
  const std::vector<Vector3d> corners = scenes::worlds::highrise_corners(kCube);
  const vision::camera::Camera camera = vision::camera::PinholeCamera::from_fov(640, 640, std::numbers::pi / 3.0);
  const Eigen::Isometry3d X_WC = looking_at({-50, 3, -40}, {0, 0, -9});
  ProjectedCorners projected(corners, 11);
  constexpr int kImages = 500;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  for (int i = 0; i < kImages; ++i) {
    const auto pixels = projected.project(camera, X_WC);
    ASSERT_EQ(pixels.size(), corners.size());
    for (size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d off = pixels[k] - *camera.project(X_WC.inverse() * corners[k]);
      sum += off;
      squares += off.cwiseAbs2();
    }
  }
  const double count = static_cast<double>(kImages * corners.size());
  const double kFiveSigmasPx = 5.0 * 0.5 / std::sqrt(count);
  EXPECT_LT((sum / count).cwiseAbs().maxCoeff(), kFiveSigmasPx);
  EXPECT_NEAR(std::sqrt(squares.x() / count), 0.5, 0.03);
  EXPECT_NEAR(std::sqrt(squares.y() / count), 0.5, 0.03);
}

}  // namespace
}  // namespace hedgehop::sim
