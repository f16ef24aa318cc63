#include "sim/verdict/map_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "scenes/worlds/highrise.h"
#include "sim/reproduce/corner_flight.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

const scenes::worlds::HighriseConfig kCube{.layout = scenes::worlds::HighriseConfig::Layout::cube};

CollisionWorld cube_world() {
  const dynamics::HullPart ball{.shape = dynamics::HullPart::Shape::box, .half_extents_m = {0.1, 0.1, 0.1}};
  return CollisionWorld(scenes::worlds::make_highrise(kCube, 1), {ball});
}

// A corner of a box is in sight exactly if one of its three faces is towards the camera.
TEST(CornersInSight, OfABoxAreThoseOfTheFacesTowardsTheCamera) {
  const CollisionWorld world = cube_world();
  const std::vector<Vector3d> corners = scenes::worlds::highrise_corners(kCube, 1);
  const vision::camera::Camera camera = vision::camera::PinholeCamera::from_fov(640, 640, std::numbers::pi / 2.0);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> side(-60.0, 60.0), height(1.0, 60.0);
  const Vector3d middle(0, 0, -9);
  int hidden = 0;
  for (int round = 0; round < 300; ++round) {
    const Vector3d p_WC(side(random), side(random), -height(random));
    const Vector3d out = (p_WC - middle).cwiseAbs();
    if (out.maxCoeff() < 30.0) continue;  // too near for an image of the whole box
    const Eigen::Isometry3d X_WC = looking_at(p_WC, middle);
    const auto seen = corners_in_sight(corners, camera, X_WC, &world, 0.0);
    for (size_t k = 0; k < corners.size(); ++k) {
      bool expected = false, grazing = false;
      for (int axis = 0; axis < 3; ++axis) {
        const double normal = corners[k][axis] > middle[axis] ? 1.0 : -1.0;
        const double above_m = normal * (p_WC[axis] - corners[k][axis]);
        grazing = grazing || std::abs(above_m) < 1.0;                        // the ray runs along that face
        if (axis < 2 || normal < 0.0) expected = expected || above_m > 0.0;  // no camera is below
      }
      if (grazing) continue;
      EXPECT_EQ(seen[k], expected) << "corner " << k << " from " << p_WC.transpose();
      hidden += !expected;
    }
  }
  EXPECT_GT(hidden, 100);
}

TEST(CornersInSight, AreAllInTheImageThroughWalls) {
  const std::vector<Vector3d> corners = scenes::worlds::highrise_corners(kCube, 1);
  const vision::camera::Camera camera = vision::camera::PinholeCamera::from_fov(640, 640, std::numbers::pi / 3.0);
  const auto seen = corners_in_sight(corners, camera, looking_at({-50, 3, -40}, {0, 0, -9}), nullptr, 0.0);
  EXPECT_EQ(std::ranges::count(seen, true), 8);
  const auto aside = corners_in_sight(corners, camera, looking_at({-50, 3, -40}, {-100, 0, -9}), nullptr, 0.0);
  EXPECT_EQ(std::ranges::count(aside, true), 0);
}

}  // namespace
}  // namespace hedgehop::sim
