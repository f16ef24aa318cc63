#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/multicopter/multicopter.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

using dynamics::control::RateSetpoint;
using dynamics::multicopter::MulticopterConfig;
using dynamics::multicopter::PerRotor;

/// A quadrotor in still air, without latency of its commands.
Scenario quadrotor(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"vehicle={use: vehicles/hummingbird.yaml}", "duration=2", "film.enabled=false", "wind={}",
                    "drawing.renderer=tiles", "scene.texture_size=128", "command_latency=0", "start.altitude=30",
                    "avoidance={module: go_to_goal, speed: 1}", "checks=[]"});
  return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/garratt2009_city_0_light.yaml", overrides);
}

PerRotor all(double speed_radps) { return PerRotor::Constant(4, speed_radps); }

/// Returns the speed at which the rotors carry the weight: m g = 4 k speed^2.
double hover_speed_radps(const Scenario& scenario) {
  const auto& config = std::get<MulticopterConfig>(scenario.vehicle);
  return std::sqrt(config.mass.mass_kg * 9.81 / (4.0 * config.rotor.thrust_ns2));
}

void fly(Simulation& simulation, const CallerCommand& command, double duration_s) {
  const double end_s = simulation.t_s() + duration_s;
  while (!simulation.over() && simulation.t_s() < end_s - 1e-6) simulation.tick(command);
}

TEST(DirectCommand, RotorsThatCarryTheWeightHoldTheVehicle) {
  Simulation simulation(quadrotor());
  const Eigen::Vector3d start_W = simulation.truth().p_WB;
  fly(simulation, DirectCommand(all(hover_speed_radps(simulation.scenario()))), 1.0);
  EXPECT_LT((simulation.truth().p_WB - start_W).norm(), 0.05);
  const DirectHover hover = direct_hover(simulation.scenario().vehicle);
  EXPECT_NEAR((hover.speeds_radps - all(hover_speed_radps(simulation.scenario()))).cwiseAbs().maxCoeff(), 0.0, 0.1);
}

TEST(DirectCommand, AVehicleWithStoppedMotorsFallsFreely) {
  Simulation simulation(quadrotor());
  const double start_m = simulation.truth().p_WB.z();
  constexpr double kFallS = 1.0, kSpinDownM = 0.6;  // the motors stop within a tenth of a second; drag is small
  fly(simulation, DirectCommand(all(0.0)), kFallS);
  EXPECT_NEAR(simulation.truth().p_WB.z() - start_m, 0.5 * 9.81 * kFallS * kFallS, kSpinDownM);
}

TEST(DirectCommand, FasterRotorsOnTheLeftRollRight) {
  Simulation simulation(quadrotor());
  const auto& arms = std::get<MulticopterConfig>(simulation.scenario().vehicle).arms;
  PerRotor speeds = all(hover_speed_radps(simulation.scenario()));
  for (size_t i = 0; i < arms.size(); ++i) {
    speeds[static_cast<Eigen::Index>(i)] -= 10.0 * std::sin(arms[i].azimuth_rad);  // the arm's way to the right
  }
  fly(simulation, DirectCommand(speeds), 0.2);
  const Eigen::Vector3d w_WB_B = simulation.truth().w_WB_B;
  EXPECT_GT(w_WB_B.x(), 0.1);
  EXPECT_LT(w_WB_B.tail<2>().norm(), 0.1 * w_WB_B.x());
}

TEST(DirectCommand, BodyRatesTurnTheVehicleByTheirIntegral) {
  Simulation simulation(quadrotor());
  const double thrust = direct_hover(simulation.scenario().vehicle).thrust;
  const Eigen::Quaterniond q_WB_start = simulation.truth().q_WB;
  fly(simulation, DirectCommand(RateSetpoint{{0.0, 0.0, 1.0}, thrust}), 1.0);
  const Eigen::AngleAxisd turned(q_WB_start.conjugate() * simulation.truth().q_WB);
  EXPECT_NEAR(turned.angle() * turned.axis().z(), 1.0, 0.1);
}

TEST(DirectCommand, TheAutopilotTakesOverFromRatesAndMotors) {
  const DirectCommand commands[] = {RateSetpoint{{0.6, -0.4, 0.3}, 0.35}, all(500.0)};
  for (const DirectCommand& command : commands) {
    Simulation simulation(quadrotor({"duration=12"}));
    fly(simulation, command, 0.5);
    fly(simulation, avoidance::HoverCommand{}, 6.0);
    EXPECT_LT(simulation.truth().v_WB_W.norm(), 0.3) << command.index();
    const Eigen::Vector3d held_W = simulation.truth().p_WB;
    fly(simulation, avoidance::HoverCommand{}, 2.0);
    EXPECT_LT((simulation.truth().p_WB - held_W).norm(), 0.5) << command.index();
  }
}

TEST(DirectCommand, EqualCommandsGiveEqualFlightsAndTheLatencyCounts) {
  const auto flown = [](const std::string& latency) {
    Simulation simulation(quadrotor({"duration=1", latency}));
    while (!simulation.over()) {
      const double sway = std::sin(20.0 * simulation.t_s());
      simulation.step(DirectCommand(RateSetpoint{{sway, 0.3 * sway, 0.1}, 0.4}));
    }
    return simulation.result();
  };
  const Flight first = flown("command_latency=0");
  EXPECT_EQ(flown("command_latency=0").result.trajectory_hash, first.result.trajectory_hash);
  EXPECT_NE(flown("command_latency=0.04").result.trajectory_hash, first.result.trajectory_hash);
  EXPECT_EQ(first.decisions.front().status, "commanded");
  EXPECT_FALSE(first.trajectory.back().altitude_cmd_m);
}

TEST(DirectCommand, ValuesOutOfRangeAreRefusedWithTheRange) {
  Simulation simulation(quadrotor());
  const auto refusal = [&](const DirectCommand& command) {
    try {
      simulation.step(command);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal(RateSetpoint{{13.0, 0.0, 0.0}, 0.5}), HasSubstr("valid: -12.57 .. 12.57"));
  EXPECT_THAT(refusal(RateSetpoint{{std::nan(""), 0.0, 0.0}, 0.5}), HasSubstr("body rates"));
  EXPECT_THAT(refusal(RateSetpoint{{0.0, 0.0, 0.0}, 7.0}), HasSubstr("valid: 0 .. 1"));
  EXPECT_THAT(refusal(RateSetpoint{{0.0, 0.0, 0.0}, -0.1}), HasSubstr("valid: 0 .. 1"));
  EXPECT_THAT(refusal(PerRotor::Constant(3, 100.0)), HasSubstr("3 motor speeds; the vehicle has 4 rotors"));
  EXPECT_THAT(refusal(all(-1.0)), HasSubstr("valid: 0 .. "));
  EXPECT_THAT(refusal(all(1e4)), HasSubstr("valid: 0 .. "));
  EXPECT_THAT(refusal(all(std::nan(""))), HasSubstr("motor speed nan"));
  EXPECT_EQ(simulation.t_s(), 0.0);
  Simulation helicopter(quadrotor({"vehicle={use: vehicles/electric_helicopter_8kg.yaml}"}));
  EXPECT_THROW(helicopter.step(DirectCommand(all(100.0))), std::invalid_argument);
}

TEST(WorldSeed, GivesTheSameWorldAndStartWithOtherNoise) {
  const std::vector<std::string> spread = {"duration=1", "start.spread=2", "world_seed=5"};
  Simulation first(quadrotor(spread)), second(quadrotor(spread));
  second.reset(77);
  ASSERT_EQ(second.scenario().world_seed, 5U);
  EXPECT_EQ(first.truth().p_WB, second.truth().p_WB);
  const auto boxes = [](const Simulation& simulation) {
    std::vector<double> north;
    for (const auto& vertex : simulation.scene().solids) north.push_back(vertex.X_WS.translation().x());
    return north;
  };
  EXPECT_EQ(boxes(first), boxes(second));
  EXPECT_NE(first.run().result.trajectory_hash, second.run().result.trajectory_hash);
  second.reset(77, 6);
  EXPECT_NE(first.truth().p_WB, second.truth().p_WB);
  EXPECT_NE(boxes(first), boxes(second));
}

TEST(WorldSeed, EqualToTheSeedGivesTheFlightOfTheSeedAlone) {
  const std::vector<std::string> plain = {"duration=1", "seed=9"}, doubled = {"duration=1", "seed=9", "world_seed=9"};
  EXPECT_EQ(Simulation(quadrotor(plain)).run().result.trajectory_hash,
            Simulation(quadrotor(doubled)).run().result.trajectory_hash);
}

}  // namespace
}  // namespace hedgehop::sim
