#include "sim/pages/plan.h"

#include <gtest/gtest.h>

#include <numbers>

#include "scenes/mesh/bodies.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloatM = 1e-5;  // outlines are rounded to float

double area_m2(const std::vector<Vector2d>& corners) {
  double twice = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

TEST(ScenePlan, ShowsRoundSolidsAsPolygonsOf32Corners) {
  const double of_circle = 16.0 * std::sin(std::numbers::pi / 16.0);  // area of the polygon in the unit circle
  const std::vector<SolidOutline> plan =
      solid_outlines({scenes::mesh::solid_of("post", scenes::mesh::Post{{3.0, 4.0, -1.0}, 0.5, 2.0}),
                      scenes::mesh::ball_of("ball", {0, 0, -9}, 2.0)});
  EXPECT_NEAR(area_m2(plan[0].corners_NE_m), of_circle * 0.25, 1e-4);
  EXPECT_NEAR(area_m2(plan[1].corners_NE_m), of_circle * 4.0, 1e-3);
  for (const Vector2d& corner : plan[0].corners_NE_m) EXPECT_NEAR((corner - Vector2d(3, 4)).norm(), 0.5, kFloatM);
  EXPECT_NEAR(plan[0].bottom_m, 1.0, 1e-12);
  EXPECT_NEAR(plan[0].top_m, 3.0, 1e-12);
  EXPECT_NEAR(plan[1].bottom_m, 7.0, 1e-12);
}

TEST(ScenePlan, ShowsTheOutlineOfAPolyhedron) {
  const scenes::mesh::Polyhedron tip{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {1, 1, -5}},
                                     {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const SolidOutline plan = solid_outlines({scenes::mesh::solid_of("tip", tip)}).front();
  EXPECT_NEAR(area_m2(plan.corners_NE_m), 6.0, kFloatM);
  EXPECT_NEAR(plan.top_m, 5.0, 1e-12);
}

TEST(ScenePlan, ShowsThePathOfAMovingObstacleAtItsWidth) {
  scenes::Mover mover;
  mover.name = "van";
  mover.motion =
      scenes::WaypointMotion{.points = {{1, 2, 0}, {3, 4, 0}}, .repeat = scenes::WaypointMotion::Repeat::round};
  mover.solids = {scenes::mesh::solid_of("van", Eigen::AlignedBox3d(Vector3d(-3, -4, -2), Vector3d(3, 4, 0)))};
  const MoverPath path = mover_paths({mover}).front();
  EXPECT_EQ(path.corners_NE_m, (std::vector<Vector2d>{{1, 2}, {3, 4}, {1, 2}}));
  EXPECT_NEAR(path.radius_m, 5.0, kFloatM);
}

TEST(ScenePlan, OutlineOfARotatedBoxHasItsArea) {
  scenes::Solid solid{.half_extents_m = {3.0, 2.0, 5.0}};
  solid.X_WS = Eigen::Translation3d(100.0, -50.0, -5.0) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ());
  const SolidOutline footprint = solid_outlines({solid}).front();
  constexpr double kFloatCoordinates = 1e-2;
  EXPECT_NEAR(area_m2(footprint.corners_NE_m), 6.0 * 4.0, kFloatCoordinates);
  EXPECT_NEAR(footprint.bottom_m, 0.0, 1e-9);
  EXPECT_NEAR(footprint.top_m, 10.0, 1e-9);
}

TEST(ScenePlan, CeilingIsAboveAndCurbBelowTheFlight) {
  EXPECT_EQ(altitude_relation({.bottom_m = 3.0, .top_m = 3.2}, 0.9, 1.1, 1.0), AltitudeRelation::above);
  EXPECT_EQ(altitude_relation({.bottom_m = 0.0, .top_m = 0.2}, 9.0, 11.0, 1.0), AltitudeRelation::below);
  EXPECT_EQ(altitude_relation({.bottom_m = 0.0, .top_m = 9.5}, 9.0, 11.0, 1.0), AltitudeRelation::at_altitude);
}

}  // namespace
}  // namespace hedgehop::sim
