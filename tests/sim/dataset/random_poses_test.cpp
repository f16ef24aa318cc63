#include "sim/dataset/random_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/vehicle.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

constexpr double kPillarM = 2.0;  // half its side

/// One pillar in the middle of a plain.
scenes::Scene one_pillar() {
  scenes::Scene scene;
  scene.bounds_NE_m = {Eigen::Vector2d(-30.0, -30.0), Eigen::Vector2d(30.0, 30.0)};
  scenes::Solid pillar;
  pillar.X_WS = Eigen::Translation3d(0.0, 0.0, -20.0);
  pillar.half_extents_m = {kPillarM, kPillarM, 20.0};
  scene.solids.push_back(pillar);
  return scene;
}

std::vector<dynamics::HullPart> small_hull() {
  dynamics::HullPart part;
  part.half_extents_m = Eigen::Vector3d::Constant(0.01);
  return {part};
}

TEST(RandomPoses, AreWithinTheirBoundsByClosedForm) {
  const scenes::Scene scene = one_pillar();
  CollisionWorld collision(scene, small_hull());
  const PoseBounds bounds{
      .min_height_m = 2.0, .max_height_m = 10.0, .max_tilt_rad = 0.2, .min_distance_m = 3.0, .max_distance_m = 12.0};
  const std::vector<RandomPose> poses = random_poses(500, bounds, 7.0, scene, collision, 3);
  ASSERT_EQ(poses.size(), 500u);
  double mean_heading_x = 0.0, mean_heading_y = 0.0, mean_height_m = 0.0;
  for (const RandomPose& pose : poses) {
    const Eigen::Vector3d p = pose.X_WB.translation();
    const Eigen::Vector2d outside = (p.head<2>().cwiseAbs() - Eigen::Vector2d::Constant(kPillarM)).cwiseMax(0.0);
    EXPECT_GE(outside.norm(), 3.0 - 0.03);
    EXPECT_LE(outside.norm(), 12.0 + 0.03);
    EXPECT_GE(-p.z(), 2.0);
    EXPECT_LE(-p.z(), 10.0);
    const Eigen::Matrix3d R = pose.X_WB.linear();
    EXPECT_LE(std::abs(std::asin(-R(2, 0))), 0.2 + 1e-12);           // pitch
    EXPECT_LE(std::abs(std::atan2(R(2, 1), R(2, 2))), 0.2 + 1e-12);  // roll
    EXPECT_GE(pose.t_s, 0.0);
    EXPECT_LE(pose.t_s, 7.0);
    EXPECT_LE(pose.v_WB_W.norm(), bounds.max_speed_mps);
    mean_heading_x += R(0, 0) / 500.0;
    mean_heading_y += R(1, 0) / 500.0;
    mean_height_m += -p.z() / 500.0;
  }
  // Means of uniform distributions, within four standard deviations.
  EXPECT_LT(std::hypot(mean_heading_x, mean_heading_y), 4.0 / std::sqrt(2.0 * 500.0));
  EXPECT_NEAR(mean_height_m, 6.0, 4.0 * 8.0 / std::sqrt(12.0 * 500.0));
}

TEST(RandomPoses, EqualArgumentsGiveEqualPosesAndOtherSeedsOthers) {
  const scenes::Scene scene = one_pillar();
  CollisionWorld first(scene, small_hull()), second(scene, small_hull());
  const auto a = random_poses(20, {}, 5.0, scene, first, 7), b = random_poses(20, {}, 5.0, scene, second, 7),
             c = random_poses(20, {}, 5.0, scene, second, 8);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].X_WB.matrix(), b[i].X_WB.matrix());
    EXPECT_NE(a[i].X_WB.matrix(), c[i].X_WB.matrix());
  }
}

TEST(RandomPoses, RefusesBoundsThatNoPoseFulfils) {
  const scenes::Scene scene = one_pillar();
  CollisionWorld collision(scene, small_hull());
  EXPECT_THAT(
      faults_of([&] { random_poses(1, {.min_distance_m = 200.0, .max_distance_m = 300.0}, 5.0, scene, collision, 1); }),
      testing::ElementsAre(testing::HasSubstr("change --height or --distance")));
}

}  // namespace
}  // namespace hedgehop::sim
