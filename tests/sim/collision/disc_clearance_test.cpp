#include "sim/collision/disc_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using SolidShape = scenes::Solid::Shape;

constexpr double kDiscReachM = 6.0;
const Eigen::AlignedBox2d kPlan(Eigen::Vector2d(-30.0, -25.0), Eigen::Vector2d(30.0, 25.0));

/// A solid anywhere in the plan, near the disc's altitude of 10 m. @param tilt_rad  about a horizontal axis.
scenes::Solid anywhere(SolidShape shape, double tilt_rad, RandomStream& random) {
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  scenes::Solid solid;
  solid.shape = shape;
  solid.half_extents_m = {between(0.3, 4.0), between(0.3, 4.0), between(0.2, 5.0)};
  if (shape != SolidShape::box) solid.half_extents_m.y() = solid.half_extents_m.x();
  if (shape == SolidShape::sphere) solid.half_extents_m.z() = solid.half_extents_m.x();
  solid.X_WS = Eigen::Translation3d(between(-30.0, 30.0), between(-25.0, 25.0), between(-20.0, 0.0)) *
               Eigen::AngleAxisd(between(0.0, 2.0 * std::numbers::pi), Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX());
  return solid;
}

/// Compares the clearance at many places with that of Bullet's distances between solids.
void expect_clearance_of_bullet(const scenes::Scene& scene, RandomStream& random) {
  const LevelDisc disc{.radius_m = 0.8, .half_thickness_m = 0.05, .altitude_m = 10.0};
  DiscClearance clearance(scene, disc, kPlan, kDiscReachM);
  CollisionWorld world(scene, {{.shape = dynamics::HullPart::Shape::cylinder,
                                .half_extents_m = {disc.radius_m, disc.radius_m, disc.half_thickness_m}}});
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector2d p(-30.0 + 60.0 * random.uniform(), -25.0 + 50.0 * random.uniform());
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.translation() = Eigen::Vector3d(p.x(), p.y(), -disc.altitude_m);
    const double bullets_m = world.query(X_WB, kDiscReachM, 0.0).obstacle_clearance_m;
    EXPECT_NEAR(clearance.at(p), std::clamp(bullets_m, 0.0, kDiscReachM), 1e-5) << "at " << p.transpose();
  }
}

TEST(DiscClearance, EqualsThatOfBullet) {
  RandomStream random(7);
  for (const SolidShape shape : {SolidShape::box, SolidShape::cylinder, SolidShape::sphere}) {
    for (const double tilt_rad : {0.0, 0.3}) {
      scenes::Scene scene;
      for (int k = 0; k < 12; ++k) scene.solids.push_back(anywhere(shape, tilt_rad, random));
      expect_clearance_of_bullet(scene, random);
    }
  }
}

TEST(DiscClearance, OfMixedAndMovingSolidsEqualsThatOfBullet) {
  RandomStream random(8);
  scenes::Scene scene;
  for (int k = 0; k < 5; ++k) {
    scene.solids.push_back(anywhere(SolidShape::box, 0.0, random));
    scene.solids.push_back(anywhere(SolidShape::box, 0.5, random));
    scene.solids.push_back(anywhere(SolidShape::sphere, 0.0, random));
  }
  scene.movers.emplace_back().solids = {anywhere(SolidShape::cylinder, 0.0, random)};
  expect_clearance_of_bullet(scene, random);
}

TEST(DiscClearance, IsZeroOnTheGroundAndTheReachInFreeAir) {
  scenes::Scene scene;
  EXPECT_EQ(DiscClearance(scene, {0.5, 0.05, 0.04}, kPlan, kDiscReachM).at({0.0, 0.0}), 0.0);
  EXPECT_EQ(DiscClearance(scene, {0.5, 0.05, 0.06}, kPlan, kDiscReachM).at({0.0, 0.0}), kDiscReachM);
  scene.has_ground = false;
  EXPECT_EQ(DiscClearance(scene, {0.5, 0.05, -3.0}, kPlan, kDiscReachM).at({30.0, 25.0}), kDiscReachM);
}

}  // namespace
}  // namespace hedgehop::sim
