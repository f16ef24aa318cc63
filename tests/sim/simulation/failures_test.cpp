#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "avoidance/go_to_goal.h"
#include "sim/config/input_error.h"
#include "sim/simulation/simulation.h"

/// Failures in flight, detected in the true motion.
namespace hedgehop::sim {
namespace {

Scenario scenario_of(const std::string& file, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"film.enabled=false", "checks=[]", "drawing.renderer=tiles"});
  return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/" + file, overrides);
}

/// A multicopter that holds its place on perfect sensors in still air.
Scenario hovering(const std::string& failures, const std::string& duration = "30") {
  return scenario_of(
      "worlds/wall.yaml",
      {"duration=" + duration, "vehicle={use: ../vehicles/hummingbird.yaml}", "velocimeter.enabled=false",
       "goal={north: 0.01, east: 0, altitude: 5, radius: 1e-6, height_tolerance: 1e-6}", "rig.cameras=[]",
       "avoidance.slow_radius=2",
       "avionics.gps={wander_horizontal: 0, wander_vertical: 0, noise: 0.01, velocity_noise: 0.01}",
       "failures=" + failures});
}

const TrajectoryRow& row_at(const Flight& flight, double t_s) {
  return *std::ranges::find_if(flight.trajectory, [t_s](const TrajectoryRow& row) { return row.t_s >= t_s - 1e-9; });
}

TEST(FailuresInFlight, AfterTheLastTickChangeNoBit) {
  const std::vector<std::string> shortened = {"duration=3"};
  const Scenario plain = scenario_of("garratt2009_city_0_light.yaml", shortened);
  Scenario failing = plain;
  for (const char* what : {"gyros", "gps", "camera.front", "servo.tail", "link"}) {
    const bool link = std::string_view(what) == "link";  // it allows `off`, not `stuck`
    failing.failures.push_back(
        {.at_s = 2.9999, .what = what, .mode = link ? FailureConfig::Mode::off : FailureConfig::Mode::stuck});
  }
  EXPECT_EQ(Simulation(failing).run().result.trajectory_hash, Simulation(plain).run().result.trajectory_hash);
}

TEST(FailuresInFlight, AreDeterministicAndListedInTheResult) {
  const std::string noisy = "[{at: 1, what: gyros, mode: noise, value: 0.02}, {at: 2, until: 3, what: gps, mode: off}]";
  const Flight a = Simulation(hovering(noisy, "4")).run(), b = Simulation(hovering(noisy, "4")).run();
  EXPECT_EQ(a.result.trajectory_hash, b.result.trajectory_hash);
  EXPECT_NE(a.result.trajectory_hash, Simulation(hovering("[]", "4")).run().result.trajectory_hash);
  EXPECT_EQ(a.result.failures, (std::vector<std::string>{"1 s to the end: gyros noise 0.02", "2 s to 3 s: gps off"}));
}

TEST(FailuresInFlight, GpsBiasMakesTheVehicleHoldSoFarOff) {
  const Flight flight = Simulation(hovering("[{at: 5, what: gps, mode: bias, value: 2, axis: y}]")).run();
  constexpr double kHoldsM = 0.3;  // the autopilot's own error on noise of 1 cm
  EXPECT_NEAR(row_at(flight, 4.9).p_WB_true.y(), 0.0, kHoldsM);
  EXPECT_NEAR(row_at(flight, 30.0).p_WB_true.y(), -2.0, kHoldsM);
  EXPECT_NEAR(row_at(flight, 30.0).p_WB_true.x(), 0.0, kHoldsM);
}

/// With a thousandth of its inertia, the autopilot's torques throw the vehicle around until its numbers overflow.
TEST(FailuresInFlight, StateThatIsNoLongerFiniteIsAFaultWithTheFiguresBefore) {
  Scenario scenario = scenario_of("worlds/wall.yaml", {"duration=5", "vehicle={use: ../vehicles/hummingbird.yaml}",
                                                       "vehicle.mass.inertia=[1e-6, 1e-6, 1e-6]"});
  for (CameraConfig& camera : scenario.rig.cameras) camera.rate_hz = 500.0;  // on every tick
  const Flight flight = Simulation(scenario).run();
  EXPECT_EQ(flight.result.outcome, Outcome::fault);
  EXPECT_THAT(flight.result.cause, testing::HasSubstr("the vehicle's state stopped being finite at "));
  EXPECT_GT(flight.result.closest_obstacle.distance_m, 1.0);
  for (const TrajectoryRow& row : flight.trajectory) EXPECT_TRUE(row.p_WB_true.allFinite());
}

TEST(FailuresInFlight, FrozenBlackAndLostCamerasDeliverThat) {
  const auto seen = [](const std::string& mode) {
    Scenario scenario =
        scenario_of("garratt2009_city_0_light.yaml",
                    {"duration=2", "failures=[{at: 1, until: 1.5, what: camera.front, mode: " + mode + "}]"});
    Simulation simulation(scenario);
    std::vector<cv::Mat> fronts;  // of the decisions from 1 s to 1.5 s
    while (simulation.t_s() < 1.5 - 1e-9) {
      if (simulation.t_s() > 1.0 - 0.041) {
        cv::Mat front;
        for (const avoidance::CameraFrame& frame : simulation.seen().frames) {
          if (frame.role == "front") front = frame.image.clone();
        }
        fronts.push_back(front);
      }
      simulation.step();
    }
    return fronts;
  };
  const auto differ = [](const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); };
  const std::vector<cv::Mat> frozen = seen("stuck"), black = seen("black"), lost = seen("off");
  ASSERT_GT(frozen.size(), 5u);
  for (size_t i = 1; i < frozen.size(); ++i) {
    EXPECT_EQ(differ(frozen[i], frozen[0]), 0.0) << i;
    EXPECT_EQ(cv::norm(black[i], cv::NORM_INF), 0.0) << i;
    EXPECT_TRUE(lost[i].empty()) << i;
  }
  EXPECT_GT(cv::norm(black[0], cv::NORM_INF), 0.0);
}

TEST(FailuresInFlight, MotorAtNineTenthsPitchesNoFasterThanByTheTorqueItLost) {
  // The front rotor of a plus loses 19 % of its thrust, a quarter of the weight, at the length of its arm;
  // the downward rate of its nose within a motor's few time constants is that torque over the inertia.
  const Flight flight = Simulation(hovering("[{at: 2, what: motor.0, mode: factor, value: 0.9}]", "3")).run();
  constexpr double kWindowS = 0.1, kWeightN = 0.716 * 9.81, kArmM = 0.17, kInertia = 0.007, kTauDownS = 0.025;
  const double torque_nm = 0.19 * 0.25 * kWeightN * kArmM;
  const double rate_radps = -torque_nm / kInertia * (kWindowS - kTauDownS);
  const double gained = row_at(flight, 2.0 + kWindowS).w_WB_B_true.y() - row_at(flight, 2.0).w_WB_B_true.y();
  EXPECT_LT(gained, 0.25 * rate_radps);  // the autopilot works against it
  EXPECT_GT(gained, rate_radps);
  EXPECT_EQ(flight.result.outcome, Outcome::timeout);
}

TEST(FailuresInFlight, StuckServoStaysToTheBit) {
  const Scenario scenario =
      scenario_of("garratt2009_city_0_light.yaml",
                  {"duration=2", "failures=[{at: 1, until: 1.5, what: servo.lateral, mode: stuck}]"});
  const Flight flight = Simulation(scenario).run();
  const auto lateral = [&](double t_s) { return row_at(flight, t_s).controls[1]; };
  EXPECT_EQ(lateral(1.1), lateral(1.0));
  EXPECT_EQ(lateral(1.5), lateral(1.0));
  EXPECT_NE(lateral(1.6), lateral(1.0));
}

TEST(FailuresInFlight, LinkLatencyDelaysACommandByItsValue) {
  // Motion begins when the first command takes effect.
  const auto first_motion_s = [](const std::string& failures) {
    Scenario scenario = hovering(failures, "8");
    scenario.goal->north_m = 30.0;
    const Flight flight = Simulation(scenario).run();
    return std::ranges::find_if(flight.trajectory, [](const TrajectoryRow& row) { return row.v_WB_W_true.x() > 0.5; })
        ->t_s;
  };
  EXPECT_NEAR(first_motion_s("[{at: 0, what: link, mode: bias, value: 2}]") - first_motion_s("[]"), 2.0, 0.03);
}

TEST(FaultsOfAssembledScenarios, AreListedWithFileAndLine) {
  const auto fault_with = [](const std::string& file, const std::vector<std::string>& overrides) -> std::string {
    try {
      Simulation(load_flight(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/" + file, overrides));
    } catch (const InputError& error) {
      return error.what();
    }
    return "flies";
  };
  EXPECT_THAT(fault_with("andert2007_forest.yaml", {"scene.keep_clear.0.radius=1000"}),
              testing::MatchesRegex(".*/andert2007_forest.yaml:[0-9]+:[0-9]+: 'scene.trees': 100; valid: .*"));
  EXPECT_THAT(fault_with("garratt2009_city_0_light.yaml", {"start.altitude=0", "drawing.renderer=tiles"}),
              testing::MatchesRegex(
                  ".*/garratt2009_city_0.yaml:[0-9]+:[0-9]+: 'start': the vehicle collides at the start: .*"));
}

}  // namespace
}  // namespace hedgehop::sim
