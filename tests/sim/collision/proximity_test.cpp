#include "sim/collision/proximity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kFarM = std::numeric_limits<double>::infinity();
constexpr double kProximityM = 1e-6;

std::vector<HullPart> helicopter() {
  return {{HullPart::Shape::cylinder, {0.0, 0.0, -0.5}, {0.9, 0.9, 0.05}},
          {HullPart::Shape::box, {0.1, 0.0, 0.0}, {0.5, 0.2, 0.25}},
          {HullPart::Shape::box, {-0.9, 0.0, -0.1}, {0.6, 0.05, 0.05}}};
}

scenes::Solid box(const Vector3d& center_W, const Vector3d& half_extents_m, double heading_rad = 0.0) {
  scenes::Solid solid;
  solid.X_WS = Eigen::Translation3d(center_W) * AngleAxisd(heading_rad, Vector3d::UnitZ());
  solid.half_extents_m = half_extents_m;
  return solid;
}

scenes::Scene grounded_scene(std::vector<scenes::Solid> solids, bool has_ground = true) {
  scenes::Scene scene;
  scene.solids = std::move(solids);
  scene.has_ground = has_ground;
  return scene;
}

Isometry3d pose(const Vector3d& p_WB, double roll_rad = 0.0, double pitch_rad = 0.0, double yaw_rad = 0.0) {
  return Eigen::Translation3d(p_WB) * AngleAxisd(yaw_rad, Vector3d::UnitZ()) *
         AngleAxisd(pitch_rad, Vector3d::UnitY()) * AngleAxisd(roll_rad, Vector3d::UnitX());
}

struct RandomPoses {
  std::mt19937_64 random;
  Isometry3d operator()(const Vector3d& center_W, const Vector3d& spread_m) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const Vector3d offset(u(random), u(random), u(random));
    return pose(center_W + spread_m.cwiseProduct(offset), 0.6 * u(random), 0.6 * u(random), 3.0 * u(random));
  }
};

// A city of `side` x `side` rotated blocks, 30 m apart.
scenes::Scene city(int side, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<scenes::Solid> solids;
  for (int i = 0; i < side * side; ++i) {
    const double height_m = 10.0 + 30.0 * u(random);
    solids.push_back(box({30.0 * (i % side), 30.0 * (i / side), -0.5 * height_m},
                         {4.0 + 5.0 * u(random), 4.0 + 5.0 * u(random), 0.5 * height_m}, 3.0 * u(random)));
  }
  return grounded_scene(std::move(solids));
}

TEST(Proximity, ClearanceOfALevelHullToAWallIsExact) {
  CollisionWorld world(grounded_scene({box({13.0, 0.0, -20.0}, {1.0, 30.0, 20.0})}), helicopter());
  const Proximity found = world.query(pose({5.0, 2.0, -10.0}), 100.0, 0.0);
  EXPECT_NEAR(found.obstacle_clearance_m, 12.0 - 5.0 - 0.9, kProximityM);  // the rotor is the part nearest to the wall
  EXPECT_EQ(found.nearest_solid, 0u);
  EXPECT_NEAR(found.nearest_point_W.x(), 12.0, kProximityM);
  EXPECT_NEAR(found.ground_clearance_m, 9.75, kProximityM);  // under the fuselage
  EXPECT_FALSE(found.collided);
}

// The rim of a disc banked by phi is R sin(phi) + h cos(phi) below its center.
TEST(Proximity, GroundClearanceOfABankedRotorFollowsItsSine) {
  const double radius_m = 0.9, half_thickness_m = 0.05, height_m = 2.0;
  CollisionWorld world(grounded_scene({}),
                       {{HullPart::Shape::cylinder, {0, 0, 0}, {radius_m, radius_m, half_thickness_m}}});
  for (double bank_rad = -1.5; bank_rad < 1.5; bank_rad += 0.01) {
    const double below_m = radius_m * std::abs(std::sin(bank_rad)) + half_thickness_m * std::cos(bank_rad);
    const Proximity found = world.query(pose({3.0, 4.0, -height_m}, bank_rad, 0.0, 1.0), 10.0, 0.0);
    EXPECT_NEAR(found.ground_clearance_m, height_m - below_m, 1e-12);
    EXPECT_EQ(found.obstacle_clearance_m, kFarM);
  }
}

TEST(Proximity, GroundClearanceOfABoxIsThatOfItsLowestCorner) {
  const Vector3d half_extents_m(0.5, 0.2, 0.25), center_B_m(0.3, -0.1, 0.4);
  CollisionWorld world(grounded_scene({}), {{HullPart::Shape::box, center_B_m, half_extents_m}});
  RandomPoses poses{std::mt19937_64(3)};
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_WB = poses({0, 0, -3}, {5, 5, 2});
    double lowest_z = -kFarM;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      lowest_z = std::max(lowest_z, (X_WB * (center_B_m + sign.cwiseProduct(half_extents_m))).z());
    }
    EXPECT_NEAR(world.query(X_WB, 10.0, 0.0).ground_clearance_m, -lowest_z, 1e-12);
  }
}

TEST(Proximity, DistinguishesAHitFromANearMiss) {
  CollisionWorld world(grounded_scene({box({13.0, 0.0, -20.0}, {1.0, 30.0, 20.0})}), helicopter());
  EXPECT_FALSE(world.query(pose({11.0999, 0.0, -10.0}), 100.0, 0.0).collided);
  const Proximity hit = world.query(pose({11.1001, 0.0, -10.0}), 100.0, 0.0);
  EXPECT_TRUE(hit.collided);
  EXPECT_LE(hit.obstacle_clearance_m, 0.0);
  EXPECT_EQ(hit.nearest_solid, 0u);
  EXPECT_TRUE(world.query(pose({13.0, 0.0, -10.0}), 100.0, 0.0).collided);  // deep inside
  EXPECT_TRUE(world.query(pose({0.0, 0.0, -0.2}), 100.0, 0.0).collided);    // fuselage in the ground
  EXPECT_FALSE(world.query(pose({0.0, 0.0, -0.3}), 100.0, 0.0).collided);
}

TEST(Proximity, ClearanceIsInfiniteBeyondTheSearchRadius) {
  CollisionWorld world(grounded_scene({box({50.0, 0.0, 0.0}, {1.0, 1.0, 1.0})}, false), helicopter());
  const Proximity beyond = world.query(pose({0, 0, 0}), 48.0, 0.0);
  EXPECT_EQ(beyond.obstacle_clearance_m, kFarM);
  EXPECT_EQ(beyond.ground_clearance_m, kFarM);
  EXPECT_FALSE(beyond.nearest_solid.has_value());
  EXPECT_FALSE(beyond.collided);
  EXPECT_NEAR(world.query(pose({0, 0, 0}), 48.2, 0.0).obstacle_clearance_m, 48.1, kProximityM);
  EXPECT_EQ(world.query(pose({0, 0, 0}), 48.0, 0.0).obstacle_clearance_m,
            kFarM);  // although the solid was found before
}

TEST(Proximity, FindsTheNearestOfTenThousandSolids) {
  const scenes::Scene scene = city(100, 1);
  CollisionWorld world(scene, helicopter());
  RandomPoses poses{std::mt19937_64(2)};
  for (int i = 0; i < 10; ++i) {
    const Isometry3d X_WB = poses({1500, 1500, -25}, {1600, 1600, 20});
    double nearest_m = kFarM;
    for (const scenes::Solid& solid : scene.solids) {
      CollisionWorld alone(grounded_scene({solid}), helicopter());
      nearest_m = std::min(nearest_m, alone.query(X_WB, kFarM, 0.0).obstacle_clearance_m);
    }
    const Proximity found = world.query(X_WB, kFarM, 0.0);
    EXPECT_EQ(found.obstacle_clearance_m, nearest_m);
    ASSERT_TRUE(found.nearest_solid.has_value());
    CollisionWorld named(grounded_scene({scene.solids[*found.nearest_solid]}), helicopter());
    EXPECT_EQ(named.query(X_WB, kFarM, 0.0).obstacle_clearance_m, nearest_m);
  }
}

TEST(Proximity, DoesNotDependOnEarlierQueries) {
  const scenes::Scene scene = city(20, 4);
  CollisionWorld traveled(scene, helicopter());
  RandomPoses poses{std::mt19937_64(6)};
  for (int i = 0; i < 300; ++i) {
    const Isometry3d X_WB = poses({300, 300, -15}, {350, 350, 15});
    CollisionWorld fresh(scene, helicopter());
    const Proximity a = traveled.query(X_WB, 60.0, 0.0), b = fresh.query(X_WB, 60.0, 0.0);
    EXPECT_EQ(a.obstacle_clearance_m, b.obstacle_clearance_m);
    EXPECT_EQ(a.nearest_solid, b.nearest_solid);
    EXPECT_EQ(a.nearest_point_W, b.nearest_point_W);
    EXPECT_EQ(a.collided, b.collided);
  }
}

TEST(Proximity, OfEquallyNearSolidsNamesTheFirst) {
  const std::vector<HullPart> ball{{HullPart::Shape::box, {0, 0, 0}, {1, 1, 1}}};
  CollisionWorld world(
      grounded_scene({box({0, 9, 0}, {1, 1, 1}), box({5, 0, 0}, {1, 1, 1}), box({-5, 0, 0}, {1, 1, 1})}, false), ball);
  EXPECT_EQ(world.query(pose({-1, 0, 0}), 20.0, 0.0).nearest_solid, 2u);
  EXPECT_EQ(world.query(pose({0, 0, 0}), 20.0, 0.0).nearest_solid, 1u);
}

// A common motion of scene and vehicle does not change the result, even by 1.5 km.
TEST(Proximity, IsInvariantUnderRigidMotionAndFarFromTheOrigin) {
  scenes::Scene here = city(5, 8);
  here.has_ground = false;
  const Isometry3d X_there =
      Eigen::Translation3d(1500.0, -1400.0, -300.0) * AngleAxisd(1.1, Vector3d(0.3, -0.5, 0.8).normalized());
  scenes::Scene there = here;
  for (scenes::Solid& solid : there.solids) solid.X_WS = X_there * solid.X_WS;
  CollisionWorld world_here(here, helicopter()), world_there(there, helicopter());
  RandomPoses poses{std::mt19937_64(9)};
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const Isometry3d X_WB = poses({60, 60, -20}, {80, 80, 20});
    const Proximity a = world_here.query(X_WB, 100.0, 0.0), b = world_there.query(X_there * X_WB, 100.0, 0.0);
    ASSERT_EQ(a.collided, b.collided);
    if (a.collided) continue;
    ++apart;
    ASSERT_NEAR(a.obstacle_clearance_m, b.obstacle_clearance_m, kProximityM);
  }
  EXPECT_GT(apart, 1000);
}

TEST(HeightAboveSurface, IsMeasuredToTheHighestRoofBelow) {
  const CollisionWorld world(
      grounded_scene({box({0, 0, -10}, {5, 5, 10}), box({0, 0, -22}, {2, 2, 2}), box({0, 0, -60}, {5, 5, 1})}),
      helicopter());
  EXPECT_NEAR(world.height_above_surface({20, 0, -30}, 0.0), 30.0, 1e-12);  // ground
  EXPECT_NEAR(world.height_above_surface({4, 0, -30}, 0.0), 10.0, 1e-12);   // roof at 20 m
  EXPECT_NEAR(world.height_above_surface({1, 1, -30}, 0.0), 6.0,
              1e-12);  // penthouse at 24 m, the slab at 59 m is above
  EXPECT_NEAR(world.height_above_surface({1, 1, -70}, 0.0), 9.0, 1e-12);  // the slab's top at 61 m
  EXPECT_EQ(world.height_above_surface({1, 1, -15}, 0.0), 0.0);           // inside
  EXPECT_EQ(world.height_above_surface({20, 0, 1}, 0.0), 0.0);            // below ground
}

TEST(HeightAboveSurface, OverATiltedRoofFollowsItsSlope) {
  const double slope_rad = 0.3;
  scenes::Solid roof = box({100.0, 0.0, -20.0}, {10.0, 10.0, 1.0});
  roof.X_WS.linear() = AngleAxisd(slope_rad, Vector3d::UnitY()).toRotationMatrix();
  const CollisionWorld world(grounded_scene({roof}), helicopter());
  for (double north_m = 93.0; north_m < 107.0; north_m += 0.5) {
    const double roof_z = -20.0 - 1.0 / std::cos(slope_rad) - (north_m - 100.0) * std::tan(slope_rad);
    EXPECT_NEAR(world.height_above_surface({north_m, 1.0, -50.0}, 0.0), 50.0 + roof_z, 1e-9);
  }
}

TEST(HeightAboveSurface, WithoutGroundOrRoofIsInfinite) {
  const CollisionWorld world(grounded_scene({box({0, 0, 0}, {1, 1, 1})}, false), helicopter());
  EXPECT_EQ(world.height_above_surface({5, 0, -10}, 0.0), kFarM);
  EXPECT_EQ(world.height_above_surface({0, 0, 10}, 0.0), kFarM);
  EXPECT_NEAR(world.height_above_surface({0, 0, -10}, 0.0), 9.0, 1e-12);
}

TEST(CollisionWorld, RefusesInvalidBodies) {
  const std::vector<HullPart> good = helicopter();
  EXPECT_THROW(CollisionWorld(grounded_scene({}), {}), std::invalid_argument);
  EXPECT_THROW(CollisionWorld(grounded_scene({}), {{HullPart::Shape::box, {0, 0, 0}, {1, 0, 1}}}),
               std::invalid_argument);
  EXPECT_THROW(CollisionWorld(grounded_scene({}), {{HullPart::Shape::cylinder, {0, 0, 0}, {1, 2, 1}}}),
               std::invalid_argument);
  EXPECT_THROW(CollisionWorld(grounded_scene({}), {{HullPart::Shape::box, {NAN, 0, 0}, {1, 1, 1}}}),
               std::invalid_argument);
  EXPECT_THROW(CollisionWorld(grounded_scene({box({0, 0, 0}, {1, 1, -1})}), good), std::invalid_argument);
  EXPECT_THROW(CollisionWorld(grounded_scene({box({0, NAN, 0}, {1, 1, 1})}), good), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim
