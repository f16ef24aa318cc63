// Surfaces of many triangles, against every triangle by brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/collision/proximity.h"
#include "sim/collision/solid_bodies.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kUnboundedM = std::numeric_limits<double>::infinity();

std::vector<HullPart> hull() {
  return {{HullPart::Shape::cylinder, {0.0, 0.0, -0.2}, {0.6, 0.6, 0.05}},
          {HullPart::Shape::box, {0.1, 0.0, 0.0}, {0.3, 0.2, 0.15}}};
}

/// A sheet of waves of 10 x 10 m, cut into 2 x side x side triangles.
scenes::Solid waves(int side, const Isometry3d& X_WS) {
  scenes::Solid solid;
  solid.shape = scenes::Solid::Shape::surface;
  solid.X_WS = X_WS;
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      const double x = 10.0 * i / side, y = 10.0 * j / side;
      solid.polyhedron.corners.emplace_back(x, y, 0.6 * std::sin(1.7 * x) * std::cos(2.3 * y));
    }
  }
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(i * (side + 1) + j); };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      solid.polyhedron.faces.push_back({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
      solid.polyhedron.faces.push_back({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return solid;
}

struct RandomPlaces {
  RandomStream random;
  double between(double low, double high) { return low + (high - low) * random.uniform(); }
  Vector3d point(double reach_m) {
    return {between(-reach_m, 10.0 + reach_m), between(-reach_m, 10.0 + reach_m), between(-reach_m, reach_m)};
  }
  Isometry3d pose(double reach_m) {
    const Vector3d axis = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    return Eigen::Translation3d(point(reach_m)) * AngleAxisd(between(-std::numbers::pi, std::numbers::pi), axis);
  }
};

class SurfaceScene : public ::testing::Test {
 protected:
  SurfaceScene() {
    const Isometry3d tilted = Eigen::Translation3d(3.0, -2.0, 1.0) * AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
    scene.has_ground = false;
    scene.solids = {waves(20, Isometry3d::Identity()), scenes::Solid{.half_extents_m = {0.5, 0.5, 0.5}},
                    waves(12, tilted)};
    for (const scenes::Solid& solid : scene.solids) {
      for (PosedBody& body : make_bodies(solid)) bodies.push_back(std::move(body));
    }
  }
  scenes::Scene scene;
  std::vector<PosedBody> bodies;  ///< of all triangles and of the box
};

TEST_F(SurfaceScene, ClearanceEqualsThatOfEveryTriangle) {
  CollisionWorld world(scene, hull());
  RandomPlaces places{RandomStream(1)};
  int touching = 0;
  for (int i = 0; i < 60; ++i) {
    const Isometry3d X_WB = places.pose(3.0);
    double nearest_m = kUnboundedM;
    for (const HullPart& part : hull()) {
      const ConvexBody body = make_body(part, "part");
      const PlacedBody placed(body, X_WB * Eigen::Translation3d(part.center_B_m));
      for (const PosedBody& other : bodies) {
        nearest_m = std::min(nearest_m, separate(placed, PlacedBody(other.body, other.X_WS)).distance_m);
      }
    }
    const Proximity found = world.query(X_WB, kUnboundedM, 0.0);
    EXPECT_NEAR(found.obstacle_clearance_m, nearest_m, 1e-9) << i;
    EXPECT_EQ(found.collided, nearest_m <= 0.0) << i;
    touching += nearest_m <= 0.0 ? 1 : 0;
  }
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 55);
}

TEST_F(SurfaceScene, RaysMeetTheSameTriangleAsByBruteForce) {
  CollisionWorld world(scene, hull());
  RandomPlaces places{RandomStream(2)};
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d from_W = places.point(2.0), to_W = places.point(2.0);
    const Vector3d ray_W = (to_W - from_W).normalized();
    double nearest_m = kUnboundedM;
    for (const PosedBody& body : bodies) {
      const Isometry3d X_SW = body.X_WS.inverse();
      nearest_m = std::min(nearest_m, body.body.ray_length(X_SW * from_W, X_SW.linear() * ray_W));
    }
    if (nearest_m > 30.0) nearest_m = kUnboundedM;
    EXPECT_EQ(world.distance_along(from_W, ray_W, 30.0, 0.0), nearest_m) << i;
    hits += std::isfinite(nearest_m) ? 1 : 0;
    const double height_m = world.height_above_surface(from_W, 0.0);
    double below_m = kUnboundedM;
    for (const PosedBody& body : bodies) {
      const Isometry3d X_SW = body.X_WS.inverse();
      below_m = std::min(below_m, body.body.ray_length(X_SW * from_W, X_SW.linear().col(2)));
    }
    EXPECT_EQ(height_m, below_m) << i;
  }
  EXPECT_GT(hits, 50);
}

TEST_F(SurfaceScene, DoesNotDependOnEarlierQueriesAndNamesTheSolid) {
  CollisionWorld traveled(scene, hull());
  RandomPlaces places{RandomStream(3)};
  for (int i = 0; i < 100; ++i) {
    const Isometry3d X_WB = places.pose(3.0);
    CollisionWorld fresh(scene, hull());
    const Proximity a = traveled.query(X_WB, 20.0, 0.0), b = fresh.query(X_WB, 20.0, 0.0);
    EXPECT_EQ(a.obstacle_clearance_m, b.obstacle_clearance_m);
    EXPECT_EQ(a.nearest_solid, b.nearest_solid);
    EXPECT_EQ(a.nearest_point_W, b.nearest_point_W);
    ASSERT_TRUE(a.nearest_solid);
    scenes::Scene alone;
    alone.has_ground = false;
    alone.solids = {scene.solids[*a.nearest_solid]};
    EXPECT_EQ(CollisionWorld(alone, hull()).query(X_WB, 20.0, 0.0).obstacle_clearance_m, a.obstacle_clearance_m);
  }
}

}  // namespace
}  // namespace hedgehop::sim
