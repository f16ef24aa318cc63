#include "avoidance/policy/action_pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::policy {
namespace {

TEST(ActionPilot, StateIsRelativeToTheVehicle) {
  // Heading east, rolled right: the goal 3 m to the south is 3 m to the right at any roll.
  NavigationState navigation;
  navigation.p_WB_est = {10.0, 20.0, -5.0};
  navigation.q_WB_est = Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX());
  navigation.v_WB_B_est = {1.0, 2.0, 3.0};
  navigation.w_WB_B_est = {0.1, 0.2, 0.3};
  navigation.height_above_ground_m = 4.5;
  const State state = state_of(navigation, {{7.0, 24.0, -6.0}, 0.0});
  const State expected{{4.0f, 3.0f, -1.0f, 1.0f, 2.0f, 3.0f, -0.3f, 0.2f, 0.3f, 4.5f}};
  EXPECT_LT((state - expected).norm(), 1e-6f);
}

TEST(ActionPilot, VelocityIsAFractionOfTheLimitAlongTheHeading) {
  const NavigationState navigation = level_flight({0, 0, -5}, 0.5 * std::numbers::pi, {0.0, 0.0});
  ActionPilot pilot(navigation);
  const VelocityCommand command = pilot.fly({0.5, -2.0, 0.0, 0.0}, navigation, 4.0, 0.1);
  EXPECT_NEAR(command.v_WB_W.x(), 4.0, 1e-12);  // left of east is north; clamped to 1
  EXPECT_NEAR(command.v_WB_W.y(), 2.0, 1e-12);
  EXPECT_NEAR(command.altitude_m, 5.0, 1e-12);
}

TEST(ActionPilot, AltitudeAndHeadingChangeAtTheirRatesWhileTheVehicleFollows) {
  NavigationState navigation = level_flight({0, 0, -5}, 3.0, {0.0, 0.0});
  ActionPilot pilot(navigation);
  VelocityCommand command;
  constexpr double kLagM = 0.4;
  for (int i = 0; i < 100; ++i) {
    command = pilot.fly({0.0, 0.0, 1.0, 0.5}, navigation, 1.0, 0.04);
    navigation = level_flight({0, 0, -command.altitude_m + kLagM}, command.heading_rad, {0.0, 0.0});
  }
  EXPECT_NEAR(command.altitude_m, 5.0 + 4.0, 1e-9);
  EXPECT_NEAR(std::remainder(command.heading_rad - (3.0 + 2.0), 2.0 * std::numbers::pi), 0.0, 1e-9);
}

TEST(ActionPilot, SetpointsStayNearAVehicleThatDoesNotFollow) {
  const NavigationState navigation = level_flight({0, 0, -5}, 0.0, {0.0, 0.0});
  ActionPilot pilot(navigation);
  VelocityCommand command;
  for (int i = 0; i < 1000; ++i) command = pilot.fly({0.0, 0.0, -1.0, 1.0}, navigation, 1.0, 0.04);
  EXPECT_NEAR(command.altitude_m, 5.0 - ActionPilot::kAheadM, 1e-12);
  EXPECT_NEAR(command.heading_rad, ActionPilot::kAheadRad, 1e-12);
}

}  // namespace
}  // namespace hedgehop::avoidance::policy
