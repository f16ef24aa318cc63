// One short flight per module past an obstacle, with rendered images, compared with a control that flies
// straight on: the whole loop from pixels to clearance. Images are small and rates low, so that each takes seconds.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/simulation/simulation.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

/// @param text  a scenario without the keys that all of them share; `~` is the folder of the configurations.
Scenario short_flight(const std::string& name, std::string text, std::vector<std::string> overrides = {}) {
  text = "name: " + name + "\nfilm: {enabled: false}\n" + text;
  const std::string configs = HEDGEHOP_SOURCE_DIR "/configs";
  for (size_t at = 0; (at = text.find('~', at)) != std::string::npos; at += configs.size())
    text.replace(at, 1, configs);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / (name + ".yaml");
  std::ofstream(file) << text;
  overrides.insert(overrides.begin(), {"scene.texture_size=128", "drawing.renderer=tiles"});
  return load_scenario(file, overrides);
}

/// Expects the module to reach its goal with `clearance_m` to spare, and the control at its speed to hit `obstacle`.
void expect_avoided(const std::string& module, const std::string& text, double clearance_m, const std::string& obstacle,
                    const std::string& control_speed_mps) {
  const Flight flight = Simulation(short_flight(module, text)).run();
  EXPECT_EQ(flight.result.outcome, Outcome::reached) << flight.result.cause;
  EXPECT_GE(flight.result.closest_obstacle.distance_m, clearance_m);
  EXPECT_TRUE(flight.result.closest_obstacle.what.starts_with(obstacle)) << flight.result.closest_obstacle.what;

  const std::string straight_on = "avoidance={module: go_to_goal, speed: " + control_speed_mps + "}";
  const Flight control = Simulation(short_flight(module + "_control", text, {straight_on})).run();
  EXPECT_EQ(control.result.outcome, Outcome::collided);
  EXPECT_TRUE(control.result.closest_obstacle.what.starts_with(obstacle)) << control.result.closest_obstacle.what;
}

TEST(AvoidanceFlight, StereoCorridorPassesATree) {
  expect_avoided("stereo_corridor", R"(
duration: 20
scene: {type: tree}
vehicle: {use: ~/vehicles/artis.yaml}
avionics: {autopilot: {speed_limit: 5, acceleration_limit: 2}}
wind: {turbulence_w20: 3}
rig:
  stereo:
    - {baseline: 0.3, width: 160, height: 120, fov: 64, rate: 10, forward: 0.5, down: 0.2, imperfections: {full_well: 8000, read_noise: 1}}
velocimeter: {enabled: false}
start: {north: -30, east: 0.5, altitude: 6}
goal: {north: 20, east: 0, altitude: 6, radius: 4}
avoidance: {module: stereo_corridor, speed: 5, target_distance: 30, stereo: {method: semi_global, disparities: 16, block: 5}}
)",
                 /*clearance_m=*/1.5, "tree", "5");
}

// Without noise, which in pairs this small makes false matches: the module then wanders, clear of the tree, past its
// time.
TEST(AvoidanceFlight, SectionGridPassesATree) {
  expect_avoided("section_grid", R"(
duration: 40
scene: {type: tree, crown_diameter: 5, height: 9}
vehicle: {use: ~/vehicles/s900.yaml}
avionics: {autopilot: {speed_limit: 2.235, acceleration_limit: 2}}
wind: {turbulence_w20: 3}
rig:
  stereo:
    - {baseline: 0.12, width: 320, height: 180, focal_x: 175, rate: 10, forward: 0.3, down: 0.15}
velocimeter: {enabled: false}
start: {north: -15, east: 0, altitude: 5}
goal: {north: 12, east: 0, altitude: 5, radius: 4}
avoidance: {module: section_grid, threshold: 9.144, threshold_time: 4.5, speck: 10, stereo: {method: block, disparities: 16, block: 9}}
)",
                 /*clearance_m=*/0.8, "tree", "2");
}

// The straight line meets the building's eastern corner.
TEST(AvoidanceFlight, FlowBalancePassesABuilding) {
  expect_avoided("flow_balance", R"(
duration: 30
scene: {type: highrise, layout: cube, scale: 0.4, walls: windows}
vehicle: {use: ~/vehicles/electric_helicopter_8kg.yaml}
wind: {turbulence_w20: 3}
rig: {use: ~/rigs/garratt2009_200.yaml}
start: {north: -15, east: 3.2, altitude: 6}
goal: {north: 8, east: 3.2, altitude: 6, radius: 4}
avoidance: {module: flow_balance, speed: 2, slow_radius: 0, loom_gain: 4, flow_gain: 5, flow: {rows: 16, cols: 16, patch: 32, margin: 14, levels: 2}}
)",
                 /*clearance_m=*/0.5, "tower", "2");
}

TEST(AvoidanceFlight, CorridorCenteringPassesAPillar) {
  expect_avoided("corridor_centering", R"(
duration: 30
scene: {type: corridor, width: 2.5, sections: [{length: 5}, {length: 2, obstacle: 0.8}, {length: 6}]}
vehicle: {use: ~/vehicles/hummingbird.yaml}
avionics: {gps: {enabled: false}, imu: {rate: 500}}
rig:
  cameras:
    - {role: fisheye, model: fisheye, width: 376, height: 240, focal_x: 72.373, view_limit: 95, rate: 10, channel: grey, pitch: -90, imperfections: {full_well: 8000, read_noise: 1}}
    - {role: down, width: 60, height: 60, fov: 50, rate: 50, channel: grey, down: 0.05, pitch: -90}
start: {north: 2, east: 0.4, altitude: 1.5}
goal: {north: 10, east: 0.4, altitude: 1.5, radius: 1}
avoidance: {module: corridor_centering}
)",
                 /*clearance_m=*/0.25, "pillar", "1");
}

// One camera: depth comes from its motion.
TEST(AvoidanceFlight, LocalMapByMotionPassesATree) {
  expect_avoided("local_map", R"(
duration: 40
scene: {type: tree}
vehicle: {use: ~/vehicles/s900.yaml}
avionics: {autopilot: {speed_limit: 5, acceleration_limit: 3}}
wind: {turbulence_w20: 3}
rig:
  cameras:
    - {role: front, width: 320, height: 180, focal_x: 175, rate: 10, channel: grey, forward: 0.3, down: 0.15, imperfections: {full_well: 8000, read_noise: 1}}
    - {role: down, width: 60, height: 60, fov: 50, rate: 50, channel: grey, down: 0.2, pitch: -90}
start: {north: -15, east: 0, altitude: 6}
goal: {north: 12, east: 0, altitude: 6, radius: 4}
avoidance: {module: local_map, depth: motion}
)",
                 /*clearance_m=*/0.8, "tree", "5");
}

TEST(AvoidanceFlight, LandmarkMapPassesABuilding) {
  expect_avoided("landmark_map", R"(
duration: 60
scene: {type: highrise, layout: cube, scale: 0.5}
vehicle: {use: ~/vehicles/gtmax.yaml}
avionics: {use: ~/avionics/shah2009.yaml}
velocimeter: {enabled: false}
wind: {turbulence_w20: 3}
rig:
  cameras:
    - {role: front, width: 320, height: 240, fov: 70, rate: 10, channel: color, forward: 0.3, imperfections: {full_well: 8000, read_noise: 1}}
start: {north: -40, east: 0, altitude: 6}
goal: {north: 25, east: 0, altitude: 6, radius: 5}
avoidance:
  module: landmark_map
  speed: 3
  map: {pixel_sigma: 1.0, position_sigma: 0.3, attitude_sigma: 0.05, correlation: 1.0, confirm: 15, unconfirmed_misses: 6}
  source: color
  behind: 12
  time_to_contact: 0
)",
                 /*clearance_m=*/2.5, "tower", "3");
}

// It explores a room without a goal. The control flight hits the wall ahead; the module turns away and continues.
TEST(AvoidanceFlight, ZigZagTurnsAwayFromTheWallAhead) {
  const std::string room = R"(
duration: 12
scene: {type: room, length: 10, width: 8}
vehicle: {use: ~/vehicles/electric_helicopter_8kg.yaml}
avionics: {gps: {enabled: false}}
rig: {use: ~/rigs/garratt2009_200.yaml}
start: {north: -1, east: 0, altitude: 1}
avoidance: {module: zig_zag, forward_speed: 1, sideways_speed: 1, flow: {rows: 1, cols: 8, patch: 32, margin: 14, levels: 2}, range_threshold: 1.0, tail: 0.25, braking: 1.7, reaction: 0.22}
)";
  const Flight flight = Simulation(short_flight("zig_zag", room)).run();
  EXPECT_EQ(flight.result.outcome, Outcome::timeout) << flight.result.cause;
  EXPECT_GE(flight.result.closest_obstacle.distance_m, 0.15);
  EXPECT_GT(flight.result.path_length_m, 6.0);  // it does not wait before the wall either

  const Flight control =
      Simulation(short_flight("zig_zag_control", room,
                              {"avoidance={module: go_to_goal, speed: 1}", "goal={north: 10, east: 0, altitude: 1}"}))
          .run();
  EXPECT_EQ(control.result.outcome, Outcome::collided);
  EXPECT_EQ(control.result.closest_obstacle.what, "north wall");
}

// A wall of 120 m across the route, and a mission that may climb: over it, and down again.
TEST(AvoidanceFlight, LocalMapClimbsOverAWallWhereTheMissionAllowsIt) {
  const std::vector<std::string> who = {"seed=1203",
                                        "vehicle.use=../../vehicles/s900.yaml",
                                        "avionics.autopilot.speed_limit=8",
                                        "avionics.autopilot.acceleration_limit=3",
                                        "rig.use=../../rigs/local_map.yaml",
                                        "velocimeter.enabled=false",
                                        "avoidance.use=../modules/local_map.yaml",
                                        "drawing.renderer=tiles",
                                        "film.enabled=false"};
  const Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/leaderboard/hard/over_wall.yaml", who);
  const Flight flight = Simulation(scenario).run();
  EXPECT_EQ(flight.result.outcome, Outcome::reached) << flight.result.cause;
  for (const CheckResult& check : flight.result.checks) EXPECT_TRUE(check.passed) << check.name;
}

}  // namespace
}  // namespace hedgehop::sim
