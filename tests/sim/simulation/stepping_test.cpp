#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "avoidance/go_to_goal.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

std::string config(const std::string& name) { return std::string(HEDGEHOP_SOURCE_DIR) + "/configs/" + name; }

/// A second of the light city, with images in every decision.
Scenario city(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"duration=1", "film.enabled=false", "drawing.renderer=tiles", "scene.texture_size=128"});
  return load_scenario(config("garratt2009_city_0_light.yaml"), overrides);
}

/// The same flight without a look, straight ahead.
Scenario straight() {
  return city({"avoidance={module: go_to_goal, speed: 3}", "duration=2", "checks=[{check: no_collision}]"});
}

void expect_equal(const Flight& a, const Flight& b) {
  EXPECT_EQ(a.result.trajectory_hash, b.result.trajectory_hash);
  EXPECT_EQ(a.result.outcome, b.result.outcome);
  EXPECT_EQ(a.result.cause, b.result.cause);
  EXPECT_EQ(a.result.decisions, b.result.decisions);
  ASSERT_EQ(a.result.checks.size(), b.result.checks.size());
  for (size_t i = 0; i < a.result.checks.size(); ++i) EXPECT_EQ(a.result.checks[i].value, b.result.checks[i].value);
  ASSERT_EQ(a.result.metrics.size(), b.result.metrics.size());
  for (size_t i = 0; i < a.result.metrics.size(); ++i) {
    const MetricValue &one = a.result.metrics[i], &other = b.result.metrics[i];
    if (one.kind == FigureKind::wall_time || (std::isnan(one.value) && std::isnan(other.value))) continue;
    EXPECT_EQ(one.value, other.value) << one.name;
  }
}

TEST(Stepping, DecisionByDecisionAndTickByTickGiveTheWholeFlight) {
  const Flight whole = Simulation(city()).run();
  Simulation by_decision(city()), by_tick(city());
  int decisions = 1, ticks = 0;
  while (by_decision.step()) ++decisions;
  while (by_tick.tick()) ++ticks;
  expect_equal(whole, by_decision.result());
  expect_equal(whole, by_tick.result());
  EXPECT_EQ(decisions, 25);  // 25 Hz; the last moment's is the 26th
  EXPECT_EQ(ticks, 499);     // 500 Hz
  EXPECT_EQ(whole.result.decisions, 26);
}

TEST(Stepping, ImagesOf30HzAreAtTheExactTimesRoundedToNanoseconds) {
  Simulation simulation(load_scenario(config("shah2009_avoid.yaml"),
                                      std::vector<std::string>{"rig.cameras.0.rate=30", "duration=2", "checks=[]",
                                                               "film.enabled=false", "drawing.renderer=tiles"}));
  for (int64_t image = 0; !simulation.over(); ++image, simulation.step()) {
    EXPECT_EQ(simulation.seen().t_ns, std::llround(static_cast<double>(image) * 1e9 / 30.0));
  }
  EXPECT_EQ(simulation.result().result.physics_rate_hz, 600);
  EXPECT_EQ(simulation.result().result.decisions, 61);
}

TEST(Stepping, AHoldAtTheStartIsAHoverBeforeTheFirstDecision) {
  Simulation simulation(city({"duration=2", "start.hold=1.5", "wind={}"}));
  const Eigen::Vector3d p_WB_start = simulation.truth().p_WB;
  while (simulation.t_s() < 1.499) {
    EXPECT_FALSE(simulation.decides());
    simulation.tick();
    EXPECT_LT((simulation.truth().p_WB - p_WB_start).norm(), 0.3);
  }
  while (!simulation.over()) simulation.tick();
  const Flight flight = simulation.result();
  EXPECT_NEAR(flight.decisions.front().t_s, 1.52, 1e-9);  // the first image at 25 Hz
  EXPECT_EQ(flight.result.decisions, 13);
}

TEST(Stepping, ResetBeginsTheSameFlightOrThatOfAnotherSeed) {
  Simulation used(city());
  const Flight first = used.run();
  used.reset();
  EXPECT_EQ(used.t_s(), 0.0);
  expect_equal(used.run(), first);
  used.reset();
  used.step();  // left in its middle
  used.reset(7);
  EXPECT_EQ(used.scenario().seed, 7U);
  expect_equal(used.run(), Simulation(city({"seed=7"})).run());
}

TEST(Stepping, AfterAResetThatFailedThereIsNoFlightUntilOneSucceeds) {
  const Scenario scenario = straight();
  bool refuses = false;
  Simulation simulation(scenario, [&]() -> std::unique_ptr<avoidance::Module> {
    if (refuses) throw InputError("refused by the test");
    return hovering(scenario.rig, {})();
  });
  const std::string hash = simulation.run().result.trajectory_hash;
  refuses = true;
  EXPECT_THROW(simulation.reset(), InputError);
  EXPECT_THROW(simulation.t_s(), std::logic_error);
  EXPECT_THROW(simulation.seen(), std::logic_error);
  EXPECT_THROW(simulation.scene(), std::logic_error);
  EXPECT_THROW(simulation.step(), std::logic_error);
  EXPECT_THROW(simulation.result(), std::logic_error);
  EXPECT_EQ(simulation.scenario().seed, scenario.seed);
  refuses = false;
  simulation.reset();
  EXPECT_EQ(simulation.run().result.trajectory_hash, hash);
}

TEST(Stepping, CommandsOfTheCallerGiveTheFlightOfAModuleWithTheSameLaw) {
  Simulation commanded(straight());
  while (!commanded.over()) {
    const avoidance::Observation seen = commanded.seen();
    const Eigen::Vector2d p_BG_W = (seen.goal.p_WG - seen.navigation.p_WB_est).head<2>();
    commanded.step(avoidance::VelocityCommand{avoidance::velocity_to_goal(p_BG_W, 3.0, 4.0), -seen.goal.p_WG.z(),
                                              seen.goal.heading_rad});
  }
  const Flight by_module = Simulation(straight()).run(), from_outside = commanded.result();
  EXPECT_EQ(from_outside.result.trajectory_hash, by_module.result.trajectory_hash);
  EXPECT_EQ(from_outside.decisions.front().status, "commanded");
}

TEST(Stepping, ACommandThatIsNotFiniteIsRefusedAndLeavesNoTrace) {
  Simulation simulation(straight());
  simulation.step();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulation.step(avoidance::VelocityCommand{{nan, 0.0}, 10.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(simulation.tick(avoidance::HoverCommand{INFINITY}), std::invalid_argument);
  EXPECT_EQ(simulation.run().result.trajectory_hash, Simulation(straight()).run().result.trajectory_hash);
}

TEST(Stepping, ASpeedAboveTheLimitIsScaledDownToIt) {
  Simulation simulation(straight());
  const double limit_mps = simulation.scenario().avionics.autopilot.speed_limit_mps;
  simulation.step(avoidance::VelocityCommand{{-3e3, 4e3}, 10.0, 0.0});
  while (simulation.step()) {
  }
  const Eigen::Vector2d commanded = simulation.result().decisions.front().v_WB_W_cmd.value();
  EXPECT_NEAR(commanded.x(), -0.6 * limit_mps, 1e-9);
  EXPECT_NEAR(commanded.y(), 0.8 * limit_mps, 1e-9);
}

TEST(Stepping, AFlightThatIsOverGivesItsResultAndTakesNoStep) {
  Simulation simulation(city({"duration=0.1"}));
  EXPECT_THROW(simulation.result(), std::logic_error);
  const std::vector<CheckResult> at_first = simulation.checks_so_far();
  EXPECT_FALSE(at_first.empty());
  simulation.run();
  EXPECT_TRUE(simulation.over());
  EXPECT_THROW(simulation.step(), std::logic_error);
  EXPECT_THROW(simulation.tick(), std::logic_error);
  EXPECT_THROW(simulation.step(avoidance::HoverCommand{}), std::logic_error);
  EXPECT_EQ(simulation.result().result.flight_time_s, 0.1);
}

TEST(Stepping, QueriesDoNotChangeTheFlight) {
  Simulation asked(city());
  while (!asked.over()) {
    asked.image("front", ImageChannel::color);
    asked.image("left", ImageChannel::depth);
    asked.checks_so_far();
    asked.step();
  }
  expect_equal(asked.result(), Simulation(city()).run());
}

/// Requests the data of all sensors, as an export does.
class SensorWatcher : public FlightWatcher {
 public:
  bool wants_sensors() const override { return true; }
  void on_sensors(const SensorTick& tick) override { frames += tick.frames.size(); }
  size_t frames = 0;
};

/// A camera with automatic exposure has a state, which the images of the hold change.
TEST(Stepping, AWatcherOfTheSensorsDoesNotChangeTheFlight) {
  const Scenario scenario =
      load_scenario(config("zingg2010_corridor_4m.yaml"),
                    std::vector<std::string>{"duration=2", "start.hold=1", "film.enabled=false",
                                             "rig.sensor.auto_exposure=0.5", "checks=[]", "drawing.renderer=tiles"});
  SensorWatcher watcher;
  const Flight watched = Simulation(scenario, {}, &watcher).run();
  EXPECT_GT(watcher.frames, 0u);
  expect_equal(watched, Simulation(scenario).run());
}

TEST(Stepping, TruthAndEstimateAreThoseOfTheTrajectory) {
  Simulation simulation(city());
  std::vector<TrueMotion> truth;
  std::vector<Eigen::Vector3d> p_WB_est;
  while (!simulation.over()) {
    truth.push_back(simulation.truth());
    p_WB_est.push_back(simulation.seen().navigation.p_WB_est);
    simulation.step();
  }
  const Flight flight = simulation.result();
  for (size_t i = 0; i < truth.size(); ++i) {
    const TrajectoryRow& row = flight.trajectory.at(4 * i);  // 100 Hz compared with 25 Hz
    EXPECT_EQ(row.p_WB_true, truth[i].p_WB);
    EXPECT_EQ(row.p_WB_est, p_WB_est[i]);
  }
}

TEST(Stepping, AFlightStepsToACollisionWithoutADecisionInIt) {
  Scenario scenario = straight();
  scenario.start.altitude_m = 0.5;  // sinks to the ground
  Simulation simulation(scenario);
  while (simulation.step(avoidance::VelocityCommand{{0.0, 0.0}, -5.0, 0.0})) {
  }
  const Flight flight = simulation.result();
  EXPECT_EQ(flight.result.outcome, Outcome::collided);
  EXPECT_TRUE(simulation.proximity().collided);
  EXPECT_LT(flight.decisions.back().t_s, flight.result.flight_time_s);  // a module would decide in the last moment, too
}

TEST(Stepping, SimulationsOnSeveralThreadsFlyAsAlone) {
  const std::string alone = Simulation(city()).run().result.trajectory_hash;
  std::vector<std::string> hashes(3);
  std::vector<std::thread> threads;
  for (std::string& hash : hashes) {
    threads.emplace_back([&hash] { hash = Simulation(city()).run().result.trajectory_hash; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string& hash : hashes) EXPECT_EQ(hash, alone);
}

/// Many begin and end while others fly.
TEST(Stepping, SimulationsBeginAndEndOnSeveralThreadsAtATime) {
  const Scenario brief = city({"duration=0.1"});
  const std::string alone = Simulation(brief).run().result.trajectory_hash;
  std::vector<int> equal(4, 0);
  std::vector<std::thread> threads;
  for (int& count : equal) {
    threads.emplace_back([&] {
      for (int i = 0; i < 15; ++i) count += Simulation(brief).run().result.trajectory_hash == alone ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(equal, std::vector<int>(4, 15));
}

TEST(Stepping, HoveringReceivesTheGivenCameras) {
  const Scenario scenario = city();
  Simulation simulation(scenario, hovering(scenario.rig, {"front", "down"}));
  ASSERT_EQ(simulation.seen().frames.size(), 2U);
  EXPECT_EQ(simulation.seen().frames[0].role, "front");
  EXPECT_THROW(hovering(scenario.rig, {"top"}), InputError);
}

TEST(Stepping, AScenarioOfATextFliesAsThatOfItsFile) {
  const Scenario from_file = city();
  LoadedScenario from_text = load_flight_text(to_yaml(from_file));
  EXPECT_EQ(Simulation(std::move(from_text)).run().result.trajectory_hash,
            Simulation(from_file).run().result.trajectory_hash);
  try {
    load_flight_text("name: x\nscene: 3\n");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scenario text:2:8"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hedgehop::sim
