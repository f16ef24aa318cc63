// Spheres, cylinders, polyhedra and moving bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "scenes/mesh/bodies.h"
#include "scenes/mesh/mesh_builder.h"
#include "sim/collision/convex_body.h"
#include "sim/collision/proximity.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using scenes::Solid;
using Shape = ConvexBody::Shape;

constexpr double kExactM = 2e-7;  // separate() has 1e-7; the closed forms add rounding
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Isometry3d placed_at(const Vector3d& p) { return Isometry3d(Eigen::Translation3d(p)); }

Vector3d random_vector(Random& random, double below) {
  std::uniform_real_distribution<double> uniform(-below, below);
  return {uniform(random), uniform(random), uniform(random)};
}

Isometry3d random_pose(Random& random, double below) {
  const Eigen::Quaterniond q(Eigen::Vector4d(random_vector(random, 1.0).homogeneous()));
  return Eigen::Translation3d(random_vector(random, below)) * q.normalized();
}

ConvexBody random_body(Random& random) {
  std::uniform_real_distribution<double> size(0.1, 1.5);
  const double r = size(random);
  switch (random() % 3) {
    case 0:
      return {Shape::box, {r, size(random), size(random)}};
    case 1:
      return {Shape::cylinder, {r, r, size(random)}};
    default:
      return ConvexBody(scenes::mesh::convex_lump(12, 0.4, random));
  }
}

// A box as a polyhedron of twelve triangles.
scenes::mesh::Polyhedron box_faces(const Vector3d& half_m) {
  scenes::mesh::Polyhedron box;
  for (int k = 0; k < 8; ++k) {
    const Vector3d sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    box.corners.push_back(half_m.cwiseProduct(sign));
  }
  box.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return box;
}

TEST(Spheres, SeparationIsCenterDistanceMinusRadii) {
  const ConvexBody ball(Shape::sphere, Vector3d::Constant(0.7)), marble(Shape::sphere, Vector3d::Constant(0.2));
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = random_vector(random, 3.0);
    const Separation found = separate(PlacedBody(ball, placed_at(Vector3d::Zero())), PlacedBody(marble, placed_at(p)));
    EXPECT_NEAR(found.distance_m, p.norm() - 0.9, 1e-12);
  }
}

TEST(Spheres, SeparationFromABodyMatchesSamples) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const ConvexBody body = random_body(random), ball(Shape::sphere, Vector3d::Constant(0.5));
    const PlacedBody placed(body, random_pose(random, 1.0)), sphere(ball, random_pose(random, 4.0));
    const Separation one = separate(placed, sphere), other = separate(sphere, placed);
    ASSERT_EQ(one.distance_m, other.distance_m);
    if (one.distance_m <= 0.0) continue;
    ASSERT_NEAR((one.on_first_W - one.on_second_W).norm(), one.distance_m, 1e-9);
    // A slab between the bodies is at most as wide as the distance, and this one is as wide.
    const Vector3d n = (one.on_second_W - one.on_first_W).normalized();
    ASSERT_NEAR(-sphere.extent(-n) - placed.extent(n), one.distance_m, 1e-9);
  }
}

TEST(Spheres, DepthInsideABoxIsTheDistanceToItsSurface) {
  const ConvexBody box(Shape::box, {1.0, 2.0, 3.0}), ball(Shape::sphere, Vector3d::Constant(0.25));
  const PlacedBody origin(box, placed_at(Vector3d::Zero()));
  EXPECT_NEAR(separate(origin, PlacedBody(ball, placed_at({0.8, 0.0, 0.0}))).distance_m, -0.45, 1e-12);
  EXPECT_NEAR(separate(origin, PlacedBody(ball, placed_at({0.0, -1.9, 1.0}))).distance_m, -0.35, 1e-12);
}

TEST(Polyhedra, OfABoxEqualTheBox) {
  Random random(3);
  int apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d half_m = Vector3d(1, 1, 1) + random_vector(random, 0.9);
    const ConvexBody box(Shape::box, half_m), faces(box_faces(half_m)), other = random_body(random);
    const Isometry3d X = random_pose(random, 2.0);
    const PlacedBody second(other, random_pose(random, 5.0));
    const double with_box = separate(PlacedBody(box, X), second).distance_m;
    const double with_faces = separate(PlacedBody(faces, X), second).distance_m;
    if (with_box <= 0.0) {
      ASSERT_LE(with_faces, kExactM);
      continue;
    }
    ++apart;
    ASSERT_NEAR(with_faces, with_box, kExactM) << "pair " << i;
  }
  EXPECT_GT(apart, 1500);
}

TEST(Polyhedra, NearestPointAgreesWithManySamples) {
  Random random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const ConvexBody lump(scenes::mesh::convex_lump(24, 0.4, random));
    const Vector3d p = random_vector(random, 3.0);
    const double found_m = (lump.nearest(p) - p).norm();
    if (found_m == 0.0) {
      EXPECT_GE(lump.depth_m(p), 0.0);
      continue;
    }
    double best_m = kInfinity;
    for (const auto& [a, b, c] : lump.polyhedron.faces) {
      for (int k = 0; k < 300; ++k) {
        const double s = std::sqrt(share(random)), t = share(random);
        const std::vector<Vector3d>& corners = lump.polyhedron.corners;
        best_m = std::min(best_m, (corners[a] * (1 - s) + corners[b] * s * (1 - t) + corners[c] * s * t - p).norm());
      }
    }
    EXPECT_LE(found_m, best_m + 1e-12);
    EXPECT_GT(found_m, best_m - 0.05);
  }
}

TEST(Polyhedra, SingleTrianglesAreFlat) {
  const ConvexBody triangle(scenes::mesh::Polyhedron{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});
  const ConvexBody disc(Shape::cylinder, {0.5, 0.5, 0.1});
  const PlacedBody flat(triangle, placed_at(Vector3d::Zero()));
  EXPECT_NEAR(separate(PlacedBody(disc, placed_at({1, 1, -3})), flat).distance_m, 2.9, kExactM);
  EXPECT_NEAR(separate(PlacedBody(disc, placed_at({1, 1, 3})), flat).distance_m, 2.9, kExactM);
  EXPECT_NEAR(separate(PlacedBody(disc, placed_at({-2, 1, 0})), flat).distance_m, 1.5, kExactM);
  EXPECT_NEAR(separate(PlacedBody(disc, placed_at({3, 3, 0})), flat).distance_m, std::numbers::sqrt2 - 0.5, kExactM);
  EXPECT_LE(separate(PlacedBody(disc, placed_at({1, 1, 0.05})), flat).distance_m, 0.0);
}

TEST(Rays, EnterABodyAtZeroDistanceFromIt) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) {
    const ConvexBody body = i % 4 ? random_body(random) : ConvexBody(Shape::sphere, Vector3d::Constant(0.8));
    const Vector3d p = random_vector(random, 3.0), ray = random_vector(random, 1.0).normalized();
    const double length = body.ray_length(p, ray);
    // Brute force: advance along the ray by the distance to the body, which never passes it.
    double way = 0.0;
    const auto step = [&] { return (body.nearest(p + way * ray) - p - way * ray).norm(); };
    for (int k = 0; k < 3000 && way < 10.0 && step() >= 1e-10; ++k) way += step();
    if (way >= 10.0) {
      ASSERT_EQ(length, kInfinity) << "ray " << i;
    } else if (step() < 1e-10 || std::isfinite(length)) {
      ++hits;
      ASSERT_NEAR(length, way, 1e-4) << "ray " << i;  // the steps are short along the surface
    }
  }
  EXPECT_GT(hits, 300);
}

scenes::Scene scene_of(std::vector<Solid> solids) {
  scenes::Scene scene;
  scene.has_ground = false;
  scene.solids = std::move(solids);
  return scene;
}

std::vector<HullPart> small_helicopter() {
  return {{HullPart::Shape::cylinder, {0.0, 0.0, -0.3}, {0.9, 0.9, 0.03}},
          {HullPart::Shape::box, {0.1, 0.0, 0.0}, {0.4, 0.15, 0.2}}};
}

TEST(MovingBodies, CollideAtTheirPositionAtThatTime) {
  scenes::Mover mover;
  mover.motion = scenes::WaypointMotion{.points = {{10, 0, 5}, {-10, 0, 5}}, .speed_mps = 2.0};
  mover.solids = {scenes::mesh::ball_of("ball", {0, 0, -1}, 1.0),
                  scenes::mesh::solid_of("post", scenes::mesh::Post{{0, 0, 0}, 0.1, 1.0})};
  scenes::Scene scene =
      scene_of({scenes::mesh::solid_of("wall", Eigen::AlignedBox3d(Vector3d(-1, 30, -9), Vector3d(1, 31, 0)))});
  scene.movers = {mover};
  CollisionWorld world(scene, small_helicopter());
  Random random(6);
  std::uniform_real_distribution<double> time(0.0, 15.0);
  for (int i = 0; i < 500; ++i) {
    const double t_s = time(random), north_m = std::max(10.0 - 2.0 * t_s, -10.0);
    std::vector<Solid> still = scene.solids;
    for (Solid solid : mover.solids) {
      solid.X_WS.pretranslate(Vector3d(north_m, 0, -5));
      still.push_back(solid);
    }
    CollisionWorld frozen(scene_of(still), small_helicopter());
    const Isometry3d X_WB = placed_at(random_vector(random, 8.0) + Vector3d(0, 3, -6));
    const Proximity a = world.query(X_WB, 100.0, t_s), b = frozen.query(X_WB, 100.0, 0.0);
    ASSERT_EQ(a.collided, b.collided);
    ASSERT_EQ(a.nearest_solid, b.nearest_solid);
    ASSERT_NEAR(a.obstacle_clearance_m, b.obstacle_clearance_m, a.collided ? 1e-3 : kExactM);
    const Vector3d above = X_WB.translation();
    ASSERT_EQ(std::isfinite(world.height_above_surface(above, t_s)),
              std::isfinite(frozen.height_above_surface(above, 0)));
    if (std::isfinite(frozen.height_above_surface(above, 0.0))) {
      ASSERT_NEAR(world.height_above_surface(above, t_s), frozen.height_above_surface(above, 0.0), 1e-9);
    }
  }
}

TEST(MovingBodies, CollideInTheirAttitudeAtThatTime) {
  const Vector3d axis = Vector3d(0.4, 0.7, -0.6).normalized(), half_m(0.5, 1.5, 2.5);
  const auto X_WM = [&](double t_s) {
    return Isometry3d(Eigen::Translation3d(2.0 - t_s, 0.5 * t_s, -8.0) * AngleAxisd(0.7 * t_s, axis));
  };
  std::vector<scenes::PoseRow> rows;
  for (int i = 0; i <= 40; ++i) {
    rows.push_back({0.1 * i, X_WM(0.1 * i).translation(), Eigen::Quaterniond(X_WM(0.1 * i).linear())});
  }
  scenes::Mover mover;
  mover.motion = scenes::TableMotion{.poses = std::make_shared<const scenes::PoseTable>(rows)};
  mover.solids = {scenes::mesh::solid_of("slab", Eigen::AlignedBox3d(-half_m, half_m))};
  scenes::Scene scene;
  scene.movers = {mover};
  CollisionWorld world(scene, small_helicopter());
  EXPECT_NEAR(scenes::reach_m(mover), half_m.norm(), 1e-12);
  Random random(7);
  std::uniform_real_distribution<double> time(0.0, 4.0);
  for (int i = 0; i < 300; ++i) {
    const double t_s = time(random);
    Solid still = mover.solids[0];
    still.X_WS = X_WM(t_s) * still.X_WS;
    CollisionWorld frozen(scene_of({still}), small_helicopter());
    const Isometry3d X_WB = random_pose(random, 5.0);
    const Proximity a = world.query(Eigen::Translation3d(0, 0, -8) * X_WB, 100.0, t_s);
    const Proximity b = frozen.query(Eigen::Translation3d(0, 0, -8) * X_WB, 100.0, 0.0);
    ASSERT_EQ(a.collided, b.collided);
    ASSERT_NEAR(a.obstacle_clearance_m, b.obstacle_clearance_m, a.collided ? 1e-3 : 1e-6);
    const Vector3d from_W(-6, 0.3, -8);
    ASSERT_NEAR(std::min(world.distance_along(from_W, Vector3d::UnitX(), 50.0, t_s), 99.0),
                std::min(frozen.distance_along(from_W, Vector3d::UnitX(), 50.0, 0.0), 99.0), 1e-6);
  }
}

TEST(HeightAboveSurface, OfASphereAndAPostIsTheirTop) {
  const CollisionWorld world(scene_of({scenes::mesh::ball_of("ball", {0, 0, -10}, 2.0),
                                       scenes::mesh::solid_of("post", scenes::mesh::Post{{9, 0, 0}, 1.0, 4.0})}),
                             small_helicopter());
  EXPECT_NEAR(world.height_above_surface({0, 0, -20}, 0.0), 8.0, 1e-12);
  EXPECT_NEAR(world.height_above_surface({0, 1, -20}, 0.0), 10.0 - std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(world.height_above_surface({9.6, 0.6, -20}, 0.0), 16.0, 1e-12);
  EXPECT_EQ(world.height_above_surface({9.8, 0.8, -20}, 0.0), kInfinity);
}

TEST(CollisionWorld, SurfacesCollideAtTheirTrianglesOnly) {
  Solid shell;
  shell.shape = Solid::Shape::surface;
  shell.polyhedron = box_faces({5, 5, 5});
  Solid hull = shell;
  hull.shape = Solid::Shape::hull;
  CollisionWorld hollow(scene_of({shell}), small_helicopter()), full(scene_of({hull}), small_helicopter());
  const Proximity inside = hollow.query(placed_at(Vector3d::Zero()), 50.0, 0.0);
  EXPECT_FALSE(inside.collided);
  EXPECT_NEAR(inside.obstacle_clearance_m, 4.1, kExactM);
  EXPECT_TRUE(full.query(placed_at(Vector3d::Zero()), 50.0, 0.0).collided);
  for (const double north_m : {7.0, 20.0, -30.0}) {
    EXPECT_NEAR(hollow.query(placed_at({north_m, 1, 0}), 50.0, 0.0).obstacle_clearance_m,
                full.query(placed_at({north_m, 1, 0}), 50.0, 0.0).obstacle_clearance_m, kExactM);
  }
}

TEST(CollisionWorld, RefusesInvalidPolyhedra) {
  const auto refused = [](auto change) {
    Solid solid;
    solid.shape = Solid::Shape::hull;
    solid.polyhedron = box_faces({1, 1, 1});
    change(solid);
    EXPECT_THROW(CollisionWorld(scene_of({solid}), small_helicopter()), std::invalid_argument);
  };
  refused([](Solid& s) { s.polyhedron.faces.clear(); });
  refused([](Solid& s) { s.polyhedron.faces[0][1] = 8; });
  refused([](Solid& s) { std::swap(s.polyhedron.faces[0][1], s.polyhedron.faces[0][2]); });
  refused([](Solid& s) { s.polyhedron.corners[3] *= 0.2; });
  refused([](Solid& s) { s.polyhedron.corners[3].x() = NAN; });
}

}  // namespace
}  // namespace hedgehop::sim
