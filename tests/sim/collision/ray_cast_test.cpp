#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "sim/collision/proximity.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

constexpr double kMissedM = std::numeric_limits<double>::infinity();
constexpr double kReachM = 100.0;
constexpr double kRayM = 1e-9;
constexpr double kNow = 0.0;

struct RandomRays {
  std::mt19937_64 generator;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
  Vector3d within(const Vector3d& half_m) {
    const double x = (*this)(-1.0, 1.0), y = (*this)(-1.0, 1.0), z = (*this)(-1.0, 1.0);
    return half_m.cwiseProduct(Vector3d(x, y, z));
  }
};

scenes::Solid turned_box(const Vector3d& center_W, const Vector3d& half_extents_m, double heading_rad) {
  scenes::Solid solid;
  solid.X_WS = Eigen::Translation3d(center_W) * Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ());
  solid.half_extents_m = half_extents_m;
  return solid;
}

CollisionWorld world_of(const std::vector<scenes::Solid>& solids, bool has_ground = true) {
  scenes::Scene scene;
  scene.solids = solids;
  scene.has_ground = has_ground;
  return {scene, {{dynamics::HullPart::Shape::box, Vector3d::Zero(), {0.2, 0.2, 0.1}}}};
}

// Distance along the beam to a box, by three pairs of planes; 0 inside.
double by_planes(const scenes::Solid& solid, const Vector3d& p_W, const Vector3d& direction_W) {
  const Vector3d p_S = solid.X_WS.inverse() * p_W, d_S = solid.X_WS.linear().transpose() * direction_W;
  double enter_m = 0.0, leave_m = kMissedM;
  for (int axis = 0; axis < 3; ++axis) {
    const double half_m = solid.half_extents_m[axis];
    const double one_m = (-half_m - p_S[axis]) / d_S[axis], other_m = (half_m - p_S[axis]) / d_S[axis];
    enter_m = std::max(enter_m, std::min(one_m, other_m));
    leave_m = std::min(leave_m, std::max(one_m, other_m));
  }
  return enter_m <= leave_m ? enter_m : kMissedM;
}

TEST(RayCast, DistanceOfAWallIsItsNormalDistanceOverTheCosine) {
  const CollisionWorld world = world_of({turned_box({13.0, 0.0, -20.0}, {1.0, 300.0, 20.0}, 0.0)});
  for (const double angle_deg : {-80.0, -45.0, -10.0, 0.0, 10.0, 45.0, 80.0}) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    const Vector3d ahead(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_NEAR(world.distance_along({0.0, 0.0, -10.0}, ahead, kReachM, kNow), 12.0 / std::cos(angle), kRayM);
    EXPECT_EQ(world.distance_along({0.0, 0.0, -10.0}, -ahead, kReachM, kNow), kMissedM);
  }
}

TEST(RayCast, DistanceOfTheGroundIsTheHeightOverTheSine) {
  const CollisionWorld world = world_of({}), void_below = world_of({}, false);
  for (double dive = 0.2; dive < 1.5; dive += 0.1) {
    const Vector3d down(std::cos(dive), 0.0, std::sin(dive));
    EXPECT_NEAR(world.distance_along({3.0, 4.0, -7.0}, down, kReachM, kNow), 7.0 / std::sin(dive), 1e-12);
    EXPECT_EQ(world.distance_along({3.0, 4.0, -7.0}, {down.x(), 0.0, -down.z()}, kReachM, kNow), kMissedM);
    EXPECT_EQ(void_below.distance_along({3.0, 4.0, -7.0}, down, kReachM, kNow), kMissedM);
  }
  EXPECT_EQ(world.distance_along({0.0, 0.0, 0.1}, Vector3d::UnitX(), kReachM, kNow), 0.0);
}

TEST(RayCast, EndsWithItsReach) {
  const CollisionWorld world = world_of({turned_box({13.0, 0.0, -20.0}, {1.0, 30.0, 20.0}, 0.0)});
  EXPECT_EQ(world.distance_along({0.0, 0.0, -10.0}, Vector3d::UnitX(), 11.99, kNow), kMissedM);
  EXPECT_NEAR(world.distance_along({0.0, 0.0, -10.0}, Vector3d::UnitX(), 12.01, kNow), 12.0, kRayM);
  EXPECT_EQ(world.distance_along({0.0, 0.0, -10.0}, Vector3d::UnitZ(), 9.99, kNow), kMissedM);
  EXPECT_NEAR(world.distance_along({0.0, 0.0, -10.0}, Vector3d::UnitZ(), 10.01, kNow), 10.0, 1e-12);
}

// The nearest of many boxes, each by its closed form.
TEST(RayCast, AgreesWithBruteForceOverRandomCities) {
  RandomRays random{std::mt19937_64(41)};
  int hits = 0;
  for (int city = 0; city < 20; ++city) {
    std::vector<scenes::Solid> solids;
    for (int i = 0; i < 60; ++i) {
      solids.push_back(turned_box(random.within({80.0, 80.0, 20.0}),
                                  {random(0.5, 8.0), random(0.5, 8.0), random(0.5, 20.0)}, random(-3.0, 3.0)));
    }
    const CollisionWorld world = world_of(solids, false);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p_W = random.within({90.0, 90.0, 30.0}), direction_W = random.within({1.0, 1.0, 0.4}).normalized();
      double expected_m = kMissedM;
      for (const scenes::Solid& solid : solids) {
        const double along_m = by_planes(solid, p_W, direction_W);
        if (along_m <= kReachM) expected_m = std::min(expected_m, along_m);
      }
      const double found_m = world.distance_along(p_W, direction_W, kReachM, kNow);
      if (expected_m == kMissedM) {
        ASSERT_EQ(found_m, kMissedM) << city << ' ' << i;
        continue;
      }
      ++hits;
      ASSERT_NEAR(found_m, expected_m, kRayM) << city << ' ' << i;
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(RayCast, HitsSpheresAndCylindersAtTheRootsOfTheirEquations) {
  scenes::Solid sphere, post;
  sphere.shape = scenes::Solid::Shape::sphere;
  sphere.half_extents_m = {2.0, 2.0, 2.0};
  sphere.X_WS.translation() = Vector3d(0.0, 0.0, -10.0);
  post.shape = scenes::Solid::Shape::cylinder;
  post.half_extents_m = {1.0, 1.0, 10.0};
  post.X_WS.translation() = Vector3d(30.0, 0.0, -10.0);
  const CollisionWorld world = world_of({sphere, post});
  const double aside_m = 0.5;
  EXPECT_NEAR(world.distance_along({-10.0, aside_m, -10.0}, Vector3d::UnitX(), kReachM, kNow),
              10.0 - std::sqrt(4.0 - aside_m * aside_m), kRayM);
  EXPECT_NEAR(world.distance_along({10.0, aside_m, -10.0}, Vector3d::UnitX(), kReachM, kNow),
              20.0 - std::sqrt(1.0 - aside_m * aside_m), kRayM);
}

TEST(RayCast, HitsAMoverAtItsPositionAtThatTime) {
  scenes::Scene scene;
  scenes::Mover& mover = scene.movers.emplace_back();
  mover.solids.emplace_back();  // a cube of 2 m
  scenes::WaypointMotion motion;
  motion.points = {{.altitude_m = 10.0}, {.north_m = 50.0, .altitude_m = 10.0}};
  motion.speed_mps = 2.0;
  mover.motion = motion;
  const CollisionWorld world(scene, {{dynamics::HullPart::Shape::box, Vector3d::Zero(), {0.2, 0.2, 0.1}}});
  for (const double t_s : {0.0, 3.0, 8.0}) {
    EXPECT_NEAR(world.distance_along({-10.0, 0.0, -10.0}, Vector3d::UnitX(), kReachM, t_s), 9.0 + 2.0 * t_s, kRayM);
  }
}

TEST(RayCast, IsZeroInsideASolid) {
  const CollisionWorld world = world_of({turned_box({0.0, 0.0, -20.0}, {1.0, 1.0, 20.0}, 0.3)});
  EXPECT_EQ(world.distance_along({0.0, 0.0, -10.0}, Vector3d::UnitX(), kReachM, kNow), 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
