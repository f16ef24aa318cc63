#include "dynamics/helicopter/rotor_speed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/dynamics/control/closed_loop.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

HelicopterConfig governed(double max_power_w = 2000.0) {
  HelicopterConfig config;
  config.rotor_speed = GovernedEngineConfig{.max_power_w = max_power_w};
  return config;
}
constexpr double kSetRadps = 167.0;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

// Check LM5.
TEST(RotorSpeed, LM5_PowerLossInHoverSlowsTheRotorAtOnce) {
  HelicopterFlight flight(governed());
  HelicopterFlightState cut = flight.state();
  cut.rotor.integral_throttle = 0.0;
  flight.set_state(cut, kStill);
  constexpr double kDt = 1e-4;
  flight.step(flight.actuators(), kStill, kDt);
  expect_recorded_relative("rotor acceleration, rad/s2", (flight.state().rotor.speed_radps - kSetRadps) / kDt, -71.2,
                           0.01);
}

TEST(RotorSpeed, PowerLossRemovesTheEngineTorqueFromTheBody) {
  // The remaining torque is that of the tail rotor's thrust, minus the power that its drive takes from the rotor.
  HelicopterFlight flight(governed());
  HelicopterFlightState cut = flight.state();
  const HelicopterLoads hover = helicopter_loads(flight.model(), cut.airframe, flight.actuators(), kStill);
  cut.rotor.integral_throttle = 0.0;
  flight.set_state(cut, kStill);
  constexpr double kDt = 1e-4;
  flight.step(flight.actuators(), kStill, kDt);
  const double yaw_nm = flight.body().w_WB_B.z() / kDt * 0.28;
  const double engine_nm = (hover.main_rotor.power_w + hover.tail_rotor.power_w) / kSetRadps;
  EXPECT_NEAR(yaw_nm, engine_nm, 0.01 * engine_nm);
}

TEST(RotorSpeed, GovernedHoverIsSteady) {
  HelicopterFlight flight(governed());
  const BladeAngles hover = flight.actuators();
  for (int i = 0; i < 500; ++i) flight.step(hover, kStill, 0.002);
  EXPECT_NEAR(flight.state().rotor.speed_radps, kSetRadps, 1e-6);
  EXPECT_LT(flight.body().v_WB_B.norm(), 1e-6);
}

TEST(RotorSpeed, ConstantSpeedIsTheLimitOfAStrongEngine) {
  HelicopterFlight constant{HelicopterConfig{}};
  HelicopterConfig strong;
  strong.rotor_speed = GovernedEngineConfig{.max_power_w = 2e6, .proportional_gain_sprad = 0.01};
  HelicopterFlight engine{strong};
  const BladeAngles hover = constant.actuators();
  for (int i = 0; i < 1000; ++i) {
    const BladeAngles command{hover.collective_rad + 0.02 * std::sin(0.01 * i), hover.lateral_rad,
                              hover.longitudinal_rad, hover.tail_rad};
    constant.step(command, kStill, 0.001);
    engine.step(command, kStill, 0.001);
  }
  EXPECT_GT(constant.body().v_WB_B.norm(), 0.2);
  EXPECT_LT((engine.body().v_WB_B - constant.body().v_WB_B).norm(), 0.005 * constant.body().v_WB_B.norm());
}

TEST(RotorSpeed, SpeedDroopsWhenTheEngineIsAtItsLimit) {
  const GovernedEngineConfig engine;
  RotorSpeedState state{kSetRadps, 0.5};
  for (int i = 0; i < 15000; ++i) {
    const Eigen::Vector2d rate = derivative(engine, kSetRadps, state, 2200.0 * state.speed_radps / kSetRadps);
    state.speed_radps += rate[0] * 1e-3;
    state.integral_throttle += rate[1] * 1e-3;
  }
  EXPECT_EQ(throttle(engine, kSetRadps, state), 1.0);
  EXPECT_NEAR(state.speed_radps, kSetRadps * 2000.0 / 2200.0, 0.01);  // at which a load of constant torque takes 2 kW
  EXPECT_LT(state.integral_throttle, 1.2) << "the integral must not wind up";
}

TEST(RotorSpeed, AutopilotClimbsAndTheGovernorRecoversTheSpeed) {
  HelicopterFlight flight(governed());
  control::Autopilot autopilot({}, VehicleConfig(governed()));
  control::NavigationEstimate known;
  const auto look = [&] {
    const RigidBodyState& b = flight.body();
    known.p_WB_est = b.p_WB, known.q_WB_est = b.q_WB, known.v_WB_B_est = b.v_WB_B, known.w_WB_B_est = b.w_WB_B;
    return known;
  };
  flight.reset({0.0, 0.0, -10.0}, 0.0, kStill);
  autopilot.reset(look());
  double slowest = kSetRadps;
  for (int i = 0; i < 2000; ++i) {
    const Controls controls =
        autopilot.control(control::VelocitySetpoint{{0.0, 0.0}, i < 100 ? 10.0 : 13.0, 0.0}, look(), 0.01);
    for (int k = 0; k < 5; ++k) flight.step(to_blade_angles(controls), kStill, 0.002);
    slowest = std::min(slowest, flight.state().rotor.speed_radps);
  }
  EXPECT_LT(slowest, kSetRadps - 0.5);
  EXPECT_GT(slowest, 0.9 * kSetRadps);
  EXPECT_NEAR(flight.state().rotor.speed_radps, kSetRadps, 0.2);
  EXPECT_NEAR(flight.body().p_WB.z(), -13.0, 0.1);
}

TEST(RotorSpeed, VehicleSinksWithASlowRotorAfterPowerLoss) {
  HelicopterFlight flight(governed());
  HelicopterFlightState state = flight.state();
  const BladeAngles hover = flight.actuators();
  for (int i = 0; i < 5000; ++i) {
    state = flight.state();
    state.rotor.integral_throttle = -10.0;  // the governor does not open it again
    flight.set_state(state, kStill);
    flight.step(hover, kStill, 0.002);
    ASSERT_TRUE(to_vector(flight.body()).allFinite()) << i;
  }
  EXPECT_LT(flight.state().rotor.speed_radps, 0.9 * kSetRadps);
  EXPECT_GT(flight.body().p_WB.z(), 20.0);
}

TEST(RotorSpeed, RefusesAnEngineTooWeakToHover) {
  EXPECT_THAT([] { HelicopterFlight flight(governed(1000.0)); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("its engine gives 1000")));
  EXPECT_THAT([] { HelicopterFlight flight(governed(-1.0)); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("rotor_speed.max_power: must be > 0 W, got -1")));
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
