#include "sim/loop/route.h"

#include <gtest/gtest.h>

namespace hedgehop::sim {
namespace {

GoalConfig place(double north_m, double radius_m) {
  GoalConfig goal;
  goal.north_m = north_m;
  goal.altitude_m = 10.0;
  goal.radius_m = radius_m;
  return goal;
}

TEST(Route, PlacesArePassedInOrderAndTheGoalIsKept) {
  Scenario scenario;
  scenario.route = {place(10.0, 2.0), place(20.0, 3.0)};
  scenario.goal = place(30.0, 1.0);
  Route route(scenario);
  const auto fly_to = [&](double north_m) {
    route.update({north_m, 0.0, -7.0});  // 3 m low: just within the tolerance
    return route.goal().p_WG.x();
  };
  EXPECT_EQ(fly_to(0.0), 10.0);
  EXPECT_EQ(fly_to(20.0), 10.0);  // out of order: not passed
  EXPECT_EQ(fly_to(8.1), 20.0);
  EXPECT_FALSE(route.on_last());
  EXPECT_EQ(fly_to(17.0), 30.0);
  EXPECT_TRUE(route.on_last());
  EXPECT_EQ(fly_to(30.0), 30.0);
}

TEST(Route, APlaceIsNotPassedFarAboveOrBelowIt) {
  Scenario scenario;
  scenario.route = {place(10.0, 2.0)};
  scenario.goal = place(30.0, 1.0);
  Route route(scenario);
  for (const double altitude_m : {13.5, 6.5}) {
    route.update({10.0, 0.0, -altitude_m});
    EXPECT_FALSE(route.on_last()) << altitude_m;
  }
  scenario.route[0].height_tolerance_m = 4.0;
  Route wide(scenario);
  wide.update({10.0, 0.0, -13.5});
  EXPECT_TRUE(wide.on_last());
}

TEST(Route, WithoutAnyPlaceTheStartIsHeld) {
  Scenario scenario;
  scenario.start = {3.0, -4.0, 12.0, 0.5};
  const Route route(scenario);
  EXPECT_EQ(route.goal().p_WG, Eigen::Vector3d(3.0, -4.0, -12.0));
  EXPECT_EQ(route.goal().heading_rad, 0.5);
}

}  // namespace
}  // namespace hedgehop::sim
