#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

constexpr double kFaceM = 6.0;  // the wall's south face, north of the start

/// A flight north at 2 m/s and 5 m altitude into a wall.
Flight fly_into_wall(const std::string& collision_of) {
  return Simulation(
             load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/worlds/wall.yaml",
                           std::vector<std::string>{"scene.north=6", "scene.opening=~", "rig={cameras: []}",
                                                    "velocimeter.enabled=false", "film.enabled=false", "duration=20",
                                                    "drawing.renderer=tiles", "collision_of=" + collision_of}))
      .run();
}

double metric(const Flight& flight, const std::string& name) {
  for (const MetricValue& metric : flight.result.metrics) {
    if (metric.name == name) return metric.value;
  }
  return std::nan("");
}

TEST(CollisionOf, CenterEndsTheFlightAtTheFaceAndTheHullBeforeIt) {
  const Flight hull = fly_into_wall("hull"), center = fly_into_wall("center");
  ASSERT_EQ(hull.result.outcome, Outcome::collided);
  ASSERT_EQ(center.result.outcome, Outcome::collided);
  constexpr double kOneTickM = 2.5 * 0.01;  // the trajectory has 100 rows per second
  EXPECT_NEAR(center.trajectory.back().p_WB_true.x(), kFaceM, kOneTickM);
  EXPECT_LT(hull.trajectory.back().p_WB_true.x(), kFaceM - 0.3);  // the rotor is in front of the center
  EXPECT_NEAR(hull.result.closest_obstacle.distance_m, 0.0, kOneTickM);
  EXPECT_LT(center.result.closest_obstacle.distance_m, -0.3);
  EXPECT_NE(center.result.cause.find("hit wall"), std::string::npos) << center.result.cause;
  EXPECT_EQ(metric(center, "center_collision"), 1.0);
  EXPECT_EQ(metric(center, "hull_collision"), 1.0);
  EXPECT_TRUE(std::isnan(metric(hull, "center_collision")));
}

TEST(CollisionOf, FlightsAreEqualUntilTheHullMeetsTheWall) {
  const Flight hull = fly_into_wall("hull"), center = fly_into_wall("center");
  ASSERT_GT(center.trajectory.size(), hull.trajectory.size());
  for (size_t i = 0; i < hull.trajectory.size(); ++i) {
    ASSERT_EQ(hull.trajectory[i].p_WB_true, center.trajectory[i].p_WB_true) << i;
  }
}

}  // namespace
}  // namespace hedgehop::sim
