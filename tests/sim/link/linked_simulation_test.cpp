// Flights whose commands come from an autopilot in the test itself: the stand, the start and the ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "sim/loop/outside_autopilot.h"
#include "sim/scenario/flight_parts.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

using dynamics::multicopter::PerRotor;

constexpr double kHighestRadps = 838.0, kThrustNs2 = 8.54858e-6, kMassKg = 0.716;  // of the Hummingbird

LoadedScenario scenario_with(std::vector<std::string> overrides = {}) {
  return load_flight_text(R"(
name: linked
duration: 0.5
scene: {type: tree}
vehicle: {type: multicopter}
drawing: {renderer: tiles}
velocimeter: {enabled: false}
film: {enabled: false}
start: {north: -20, east: 0, altitude: 6, heading: 90}
goal: {north: 40, east: 0, altitude: 6}
avoidance: {module: go_to_goal, speed: 1}
link: {type: ardupilot_json, multicopter: {frame_class: 1, frame_type: 0}}
)",
                          overrides);
}

/// Commands all rotors alike, as the test chooses for each step, and keeps the inputs.
class TestAutopilot : public OutsideAutopilot {
 public:
  std::variant<OutsideCommand, LinkEnd> exchange(const OutsideInput& input) override {
    inputs.push_back(input);
    if (input.step == lost_at) return LinkEnd{Outcome::link_lost, "link: lost by the test"};
    const double share = input.step < rest_steps ? 0.0 : input.step < descent_at ? share_then : share_down;
    const PerRotor speeds_radps = PerRotor::Constant(4, share * kHighestRadps);
    return OutsideCommand{.actuators = speeds_radps};
  }
  void on_start(int64_t step) override { started = step; }
  LinkFigures figures() const override { return {.kind = "test", .start_tick = started}; }

  std::vector<OutsideInput> inputs;
  int64_t rest_steps = 100, descent_at = std::numeric_limits<int64_t>::max(), lost_at = -1;
  double share_then = 0.6, share_down = 0.0;
  std::optional<int64_t> started;
};

TEST(LinkedSimulation, StandHoldsTheVehicleUntilItsThrustExceedsItsWeight) {
  TestAutopilot autopilot;
  const Flight flight = Simulation(scenario_with(), nullptr, &autopilot).run();
  ASSERT_TRUE(autopilot.started);
  for (const OutsideInput& input : autopilot.inputs) {
    if (input.step >= *autopilot.started) break;
    EXPECT_EQ(input.body.p_WB, Eigen::Vector3d(-20, 0, -6));
    EXPECT_EQ(input.body.v_WB_B, Eigen::Vector3d::Zero());
    EXPECT_EQ(input.body.w_WB_B, Eigen::Vector3d::Zero());
    EXPECT_NEAR((input.specific_force_B - Eigen::Vector3d(0, 0, -9.81)).norm(), 0.0, 1e-12);
    EXPECT_TRUE(input.on_stand);
    EXPECT_FALSE(input.t_ns);
  }
  // The rotors rise to their command with a time constant of 12.5 ms.
  const double needed_radps = std::sqrt(kMassKg * 9.81 / (4.0 * kThrustNs2));
  const double rise_s = -0.0125 * std::log(1.0 - needed_radps / (0.6 * kHighestRadps));
  EXPECT_EQ(*autopilot.started, 100 + static_cast<int64_t>(std::ceil(rise_s * 1000.0)));
  EXPECT_EQ(flight.result.link->start_tick, autopilot.started);
  EXPECT_EQ(flight.result.outcome, Outcome::timeout);
}

TEST(LinkedSimulation, ClockBeginsAtTheReleaseAndTheVehicleClimbsWithItsExcessOfThrust) {
  TestAutopilot autopilot;
  const Flight flight = Simulation(scenario_with(), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.physics_rate_hz, 1000);
  EXPECT_EQ(autopilot.inputs.back().step, *autopilot.started + 499);
  EXPECT_EQ(autopilot.inputs.back().t_ns, 499'000'000);
  ASSERT_EQ(flight.trajectory.size(), 51u);
  EXPECT_NEAR(flight.trajectory.front().p_WB_true.z(), -6.0, 1e-3);
  const double speed_radps = 0.6 * kHighestRadps;
  const double climb_mps2 = 4.0 * kThrustNs2 * speed_radps * speed_radps / kMassKg - 9.81;
  const double climbed_m = -6.0 - flight.trajectory.back().p_WB_true.z();
  EXPECT_NEAR(climbed_m, 0.5 * climb_mps2 * 0.25, 0.1 * climbed_m);  // the rotors are slower at first
}

TEST(LinkedSimulation, EqualCommandsGiveEqualFlights) {
  TestAutopilot one, other;
  const Flight a = Simulation(scenario_with({"wind.speed=3", "wind.turbulence_w20=3"}), nullptr, &one).run();
  const Flight b = Simulation(scenario_with({"wind.speed=3", "wind.turbulence_w20=3"}), nullptr, &other).run();
  EXPECT_EQ(a.result.trajectory_hash, b.result.trajectory_hash);
}

/// The vehicle rests on its stand until about 0.12 s after the first step.
TEST(LinkedSimulation, GustBeginsAtItsTimeAfterTheStartOfTheFlight) {
  TestAutopilot autopilot;
  const Flight flight =
      Simulation(scenario_with({"wind.gust={speed: 5, start: 0.05, length: 1e-3, hold: 1000}"}), nullptr, &autopilot)
          .run();
  EXPECT_LT(flight.trajectory.front().t_s, 0.055);
  EXPECT_GT(flight.trajectory.back().t_s, 0.055);
  for (const TrajectoryRow& row : flight.trajectory) {
    EXPECT_NEAR(row.wind_W.x(), row.t_s < 0.055 ? 0.0 : -5.0, 1e-9) << row.t_s;
  }
  for (const OutsideInput& input : autopilot.inputs) EXPECT_TRUE(input.t_ns || input.wind_W.isZero(0.0));
}

TEST(LinkedSimulation, LostLinkEndsTheFlightWithAllUntilThen) {
  TestAutopilot autopilot;
  autopilot.lost_at = 300;
  const Flight flight = Simulation(scenario_with(), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.outcome, Outcome::link_lost);
  EXPECT_EQ(flight.result.cause, "link: lost by the test");
  EXPECT_EQ(verdict_of(flight.result), Verdict::fault);
  EXPECT_EQ(flight.trajectory.size(), static_cast<size_t>(1 + (300 - *autopilot.started) / 10));
}

TEST(LinkedSimulation, LinkLostOnTheStandLeavesAFlightOfNoTime) {
  TestAutopilot autopilot;
  autopilot.lost_at = 50;
  const Flight flight = Simulation(scenario_with(), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.outcome, Outcome::link_lost);
  EXPECT_EQ(flight.result.flight_time_s, 0.0);
  EXPECT_FALSE(flight.result.link->start_tick);
}

TEST(LinkedSimulation, VehicleThatNeverTakesOffEndsTheFlight) {
  TestAutopilot autopilot;
  autopilot.share_then = 0.3;
  const Flight flight = Simulation(scenario_with({"link.start_within=0.4"}), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.outcome, Outcome::link_lost);
  EXPECT_EQ(flight.result.cause, "link: the vehicle did not reach the start within 0.4 s");
}

TEST(LinkedSimulation, VehicleThatDescendsSlowlyRestsOnTheStand) {
  TestAutopilot autopilot;
  autopilot.share_then = 0.57;
  autopilot.descent_at = 400;
  autopilot.share_down = 0.53;  // hover: 0.541
  const Flight flight = Simulation(scenario_with({"duration=3"}), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.outcome, Outcome::timeout);
  double top_m = 0.0;
  for (const OutsideInput& input : autopilot.inputs) top_m = std::max(top_m, -input.body.p_WB.z());
  EXPECT_GT(top_m, 6.02);
  const OutsideInput& last = autopilot.inputs.back();
  EXPECT_TRUE(last.on_stand);
  EXPECT_EQ(last.body.p_WB.z(), -6.0);
  EXPECT_EQ(last.body.v_WB_B, Eigen::Vector3d::Zero());
  EXPECT_EQ(last.body.w_WB_B, Eigen::Vector3d::Zero());
  EXPECT_NEAR((last.specific_force_B - Eigen::Vector3d(0, 0, -9.81)).norm(), 0.0, 1e-12);
}

TEST(LinkedSimulation, StandDoesNotHoldAVehicleThatFallsOnIt) {
  TestAutopilot autopilot;
  autopilot.share_then = 0.8;
  autopilot.descent_at = 500;
  const Flight flight = Simulation(scenario_with({"duration=5"}), nullptr, &autopilot).run();
  EXPECT_EQ(flight.result.outcome, Outcome::collided);
  EXPECT_FALSE(autopilot.inputs.back().on_stand);
}

TEST(LinkedSimulation, ClockBeginsAtTheStartAboveTheStand) {
  TestAutopilot autopilot;
  const Flight flight =
      Simulation(scenario_with({"link.stand_altitude=5", "link.start_radius=0.1", "link.start_speed=10"}), nullptr,
                 &autopilot)
          .run();
  ASSERT_TRUE(autopilot.started);
  EXPECT_EQ(autopilot.inputs.front().body.p_WB.z(), -5.0);
  EXPECT_NEAR(flight.trajectory.front().p_WB_true.z(), -5.9, 0.01);
}

/// A sensor that measured a state that is not finite would corrupt the estimate.
TEST(LinkedSimulation, StateThatIsNotFiniteBeforeTheStartIsAFaultThatNoSensorMeasures) {
  TestAutopilot autopilot;
  autopilot.descent_at = 200;
  autopilot.share_down = std::numeric_limits<double>::quiet_NaN();
  Simulation simulation(scenario_with({"link.stand_altitude=5", "link.start_radius=0.1"}), nullptr, &autopilot);
  ASSERT_TRUE(simulation.over());
  EXPECT_FALSE(autopilot.inputs.back().on_stand);
  EXPECT_FALSE(simulation.truth().p_WB.allFinite());
  EXPECT_TRUE(simulation.seen().navigation.p_WB_est.allFinite());
  const FlightResult result = simulation.result().result;
  EXPECT_EQ(result.outcome, Outcome::fault);
  EXPECT_EQ(result.cause, "the vehicle's state stopped being finite at 0.000 s");
  EXPECT_FALSE(autopilot.started);
}

TEST(LinkedSimulation, ResetIsRefusedAndTheFlightGoesOn) {
  TestAutopilot autopilot;
  Simulation simulation(scenario_with(), nullptr, &autopilot);
  EXPECT_THROW(simulation.reset(), std::logic_error);
  EXPECT_EQ(simulation.run().result.outcome, Outcome::timeout);
}

TEST(LinkedSimulation, StandInsideAnObstacleIsRefused) {
  TestAutopilot autopilot;
  EXPECT_THROW(Simulation(scenario_with({"link.stand_altitude=0"}), nullptr, &autopilot), InputError);
}

TEST(LinkedSimulation, ModuleDecidesAndItsCommandArrivesAfterItsLatency) {
  TestAutopilot autopilot;
  Simulation(scenario_with({"command_latency=0.1"}), nullptr, &autopilot).run();
  const OutsideInput* first_decision = nullptr;
  const OutsideInput* first_command = nullptr;
  for (const OutsideInput& input : autopilot.inputs) {
    if (!first_decision && input.decision) first_decision = &input;
    if (!first_command && input.command) first_command = &input;
  }
  ASSERT_TRUE(first_decision && first_command);
  EXPECT_EQ(first_decision->t_ns, 0);
  EXPECT_EQ(first_command->t_ns, 100'000'000);
}

TEST(LinkedSimulation, ScenarioWithALinkNeedsAnAutopilotAndTheOtherWayRound) {
  EXPECT_THROW(Simulation{scenario_with()}, InputError);
  TestAutopilot autopilot;
  EXPECT_THROW(Simulation(scenario_with({"link=null"}), nullptr, &autopilot), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim
