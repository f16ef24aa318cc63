#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/flight_parts.h"
#include "sim/simulation/simulation.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

/// An error of a scenario, and a part of the message that reports it.
struct ScenarioError {
  std::string_view message;
  std::function<void(Scenario&)> make;
};

const std::vector<ScenarioError>& scenario_errors() {
  static const std::vector<ScenarioError> errors = {
      {"'film.rate': must be >= 0.01 Hz, got 0", [](Scenario& s) { s.film.rate_hz = 0.0; }},
      {"'start.heading': must be <= 360 deg", [](Scenario& s) { s.start.heading_rad = 3.0 * std::numbers::pi; }},
      {"'rig.cameras.0.rate': must be >=", [](Scenario& s) { s.rig.cameras[0].rate_hz = -1.0; }},
      {"'name': must not contain '/'", [](Scenario& s) { s.name = "a/b"; }},
      {"'physics_rate': must be <= 10000 Hz", [](Scenario& s) { s.physics_rate_hz = 20000; }},
      {"'control_rate': 300 Hz does not divide the physics rate", [](Scenario& s) { s.control_rate_hz = 300; }},
      {"'start.altitude': 10 m is outside",
       [](Scenario& s) {
         s.start.altitude_m = 10.0;
         s.altitude_band = AltitudeBandConfig{20.0, 30.0};
       }},
      {"'altitude_band.max': must be greater than 'min'",
       [](Scenario& s) {
         s.altitude_band = AltitudeBandConfig{30.0, 20.0};
       }},
      {"'rig.cameras.1.role': ", [](Scenario& s) { s.rig.cameras[1].role = s.rig.cameras[0].role; }},
      {"'rig.cameras.0.distortion': a pinhole takes", [](Scenario& s) { s.rig.cameras[0].distortion = {0.1}; }},
      {"'rig.cameras.0.imperfections.disparity_noise': ",
       [](Scenario& s) {
         s.rig.cameras[0].imperfections.emplace();
         s.rig.cameras[0].imperfections->disparity_noise_px = 1.0;
       }},
      {"'velocimeter.camera': needs a camera 'dwn'", [](Scenario& s) { s.velocimeter.camera = "dwn"; }},
      {"'avoidance': needs a camera 'front'",
       [](Scenario& s) { std::erase_if(s.rig.cameras, [](const CameraConfig& c) { return c.role == "front"; }); }},
      {"'takeover.at': must be before the end of the flight",
       [](Scenario& s) {
         s.takeover = TakeoverConfig{s.duration_s + 1.0, s.avoidance};
       }},
      {"'route': needs a 'goal'",
       [](Scenario& s) {
         s.route = {GoalConfig{}};
         s.goal.reset();
         s.checks.clear();
       }},
      {"'failures.0.what': ", [](Scenario& s) { s.failures = {FailureConfig{.at_s = 1.0, .what = "gyro"}}; }},
      {"'checks.0.name': ", [](Scenario& s) { s.checks = {MetricCheck{.name = "jerk_rmss", .at_most = 1.0}}; }},
      {"'checks.0.formula': ", [](Scenario& s) { s.checks = {FormulaCheck{.name = "f", .formula = "alwys 1 > 0"}}; }},
      {"'checks.0.reference': ",
       [](Scenario& s) { s.checks = {PathToleranceCheck{.reference = "/absent.csv", .at_most_m = 1.0}}; }},
      {"'scene.imports.0.file': '/absent.obj'",
       [](Scenario& s) { std::visit([](auto& scene) { scene.added.imports = {{.file = "/absent.obj"}}; }, s.scene); }},
  };
  return errors;
}

Scenario validated_city() {
  return load_scenario(kConfigs / "garratt2009_city_0.yaml", std::vector<std::string>{"drawing.renderer=tiles"});
}

/// The messages of a file, without their positions.
std::vector<std::string> without_positions(std::vector<std::string> lines) {
  for (std::string& line : lines) line = line.substr(line.find(": ") + 2);
  return lines;
}

TEST(Validation, RefusesAScenarioOfAProgramWithTheTextForItsFile) {
  Folder folder;
  for (const ScenarioError& error : scenario_errors()) {
    Scenario scenario = validated_city();
    error.make(scenario);
    const std::vector<std::string> of_struct = faults_of([&] { Simulation simulation(scenario); });
    EXPECT_THAT(of_struct, testing::Contains(testing::HasSubstr(std::string(error.message))));
    Folder::write("written.yaml", to_yaml(scenario));
    const std::vector<std::string> of_file = faults_of([] { load_flight("written.yaml"); });
    EXPECT_THAT(without_positions(of_file), testing::UnorderedElementsAreArray(of_struct)) << error.message;
  }
}

TEST(Validation, DoesNotCoverAModuleOfTheCaller) {
  Scenario scenario = validated_city();
  std::erase_if(scenario.rig.cameras, [](const CameraConfig& camera) { return camera.role == "front"; });
  EXPECT_THAT(faults_of([&] { Simulation simulation(scenario); }), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(faults_of([&] { Simulation simulation(scenario, hovering(scenario.rig, {"down"})); }),
              testing::IsEmpty());
}

}  // namespace
}  // namespace hedgehop::sim
