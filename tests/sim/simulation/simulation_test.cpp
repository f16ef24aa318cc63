#include "sim/simulation/simulation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/config/input_error.h"
#include "tests/sim/record/temporary_folder.h"
#include "tests/sim/render/osmesa.h"

namespace hedgehop::sim {
namespace {

/// The light city scenario, cut to a few seconds so that the suite stays quick.
Scenario short_city(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"duration=4", "film.enabled=false", "checks=[]", "drawing.renderer=tiles",
                                       "scene.texture_size=128"});
  return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/garratt2009_city_0_light.yaml", overrides);
}

/// Asks for images and draws over them, as a careless watcher might.
class ScribblingWatcher : public FlightWatcher {
 public:
  double image_rate_hz() const override { return 10.0; }
  void on_images(const ShownInstant& shown) override {
    ++images;
    for (const avoidance::CameraFrame& frame : shown.frames) cv::Mat(frame.image).setTo(255);
    if (!shown.annotated.empty()) cv::Mat(shown.annotated).setTo(255);
  }
  void on_progress(double, double, double) override { ++seconds; }
  int images = 0, seconds = 0;
};

TEST(Simulation, SameScenarioGivesTheSameFlightBitForBit) {
  const Flight first = Simulation(short_city()).run(), second = Simulation(short_city()).run();
  EXPECT_EQ(first.result.trajectory_hash, second.result.trajectory_hash);
  ASSERT_EQ(first.decisions.size(), second.decisions.size());
  EXPECT_EQ(Simulation(short_city({"seed=2"})).run().result.trajectory_hash == first.result.trajectory_hash, false);
}

TEST(Simulation, LookingOnDoesNotChangeTheFlight) {
  ScribblingWatcher watcher;
  const Flight watched = Simulation(short_city(), {}, &watcher).run();
  EXPECT_EQ(watched.result.trajectory_hash, Simulation(short_city()).run().result.trajectory_hash);
  EXPECT_EQ(watcher.images, 41);  // 10 a second over 4 s, both ends included
  EXPECT_EQ(watcher.seconds, 5);
}

TEST(Simulation, ImagesForAnObserverDoNotChangeTheFlight) {
  const auto hash = [](bool observed) {
    Simulation simulation(short_city({"duration=2", "rig.cameras.0.imperfections.auto_exposure=0.5"}));
    const std::string role = simulation.scenario().rig.cameras.front().role;
    while (simulation.step()) {
      if (observed) simulation.image(role, ImageChannel::grey);
    }
    return simulation.result().result.trajectory_hash;
  };
  EXPECT_EQ(hash(true), hash(false));
}

TEST(Simulation, ResolvedScenarioFliesTheSameFlight) {
  const Scenario scenario = short_city();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "resolved.yaml";
  std::ofstream(file) << to_yaml(scenario);
  EXPECT_EQ(Simulation(load_scenario(file)).run().result.trajectory_hash,
            Simulation(scenario).run().result.trajectory_hash);
}

TEST(Simulation, PartsBuiltByTheReaderGiveTheSameFlight) {
  const std::vector<std::string> overrides = {"duration=2", "film.enabled=false", "checks=[]",
                                              "drawing.renderer=tiles"};
  const std::string file = std::string(HEDGEHOP_SOURCE_DIR) + "/configs/garratt2009_city_0_light.yaml";
  LoadedScenario loaded = load_flight(file, overrides, /*seed=*/7);
  const Scenario scenario = loaded.scenario;
  const Flight flight = Simulation(std::move(loaded)).run();
  EXPECT_EQ(scenario.seed, 7U);
  EXPECT_EQ(flight.result.trajectory_hash, Simulation(scenario).run().result.trajectory_hash);
  EXPECT_NE(flight.result.trajectory_hash, Simulation(load_scenario(file, overrides)).run().result.trajectory_hash);
}

TEST(Simulation, CommandsTakeEffectAfterTheirLatency) {
  for (const double latency_s : {0.0, 0.04, 0.5}) {
    const Flight flight = Simulation(short_city({"duration=1", fmt::format("command_latency={}", latency_s)})).run();
    const DecisionRow& first = flight.decisions.front();
    EXPECT_EQ(flight.command_latency_s, latency_s);
    for (const TrajectoryRow& row : flight.trajectory) {
      // Until then the aircraft holds its start: no velocity is commanded.
      EXPECT_EQ(row.v_WB_W_cmd.has_value(), row.t_s >= first.t_s + latency_s - 1e-9) << row.t_s;
    }
  }
}

TEST(Simulation, AGoalIsReachedAtItsHeightNotFromUnderIt) {
  Scenario scenario =
      short_city({"duration=30", "avoidance={module: go_to_goal}", "rig={cameras: []}", "velocimeter.enabled=false"});
  scenario.goal = GoalConfig{.north_m = scenario.start.north_m,
                             .east_m = scenario.start.east_m,
                             .altitude_m = scenario.start.altitude_m + 8.0};
  const Flight flight = Simulation(scenario).run();
  EXPECT_EQ(flight.result.outcome, Outcome::reached);
  EXPECT_NEAR(-flight.trajectory.back().p_WB_true.z(), scenario.goal->altitude_m - 3.0, 0.1);
  scenario.duration_s = 0.5;
  EXPECT_EQ(Simulation(scenario).run().result.outcome, Outcome::timeout);
}

TEST(Simulation, TablesHaveTheScenariosRates) {
  const Flight flight = Simulation(short_city({"duration=2"})).run();
  EXPECT_EQ(flight.trajectory.size(), 201u);  // 100 Hz over 2 s, both ends included
  EXPECT_EQ(flight.decisions.size(), 51u);    // 25 Hz
  EXPECT_EQ(flight.result.outcome, Outcome::timeout);
  EXPECT_DOUBLE_EQ(flight.result.flight_time_s, 2.0);
}

TEST(Simulation, StartSpreadMovesTheStartBySeedWithinItsDisc) {
  const Flight a = Simulation(short_city({"duration=0.1", "start.spread=3", "seed=1"})).run();
  const Flight b = Simulation(short_city({"duration=0.1", "start.spread=3", "seed=2"})).run();
  const Eigen::Vector3d nominal = short_city().start.p_WB();
  const Eigen::Vector3d p_a = a.trajectory.front().p_WB_true, p_b = b.trajectory.front().p_WB_true;
  EXPECT_LE((p_a - nominal).norm(), 3.0);
  EXPECT_LE((p_b - nominal).norm(), 3.0);
  EXPECT_GT((p_a - p_b).norm(), 1e-3);
}

TEST(Simulation, FlyingIntoAWallEndsWithACollisionThatNamesIt) {
  // Straight at the room's northern wall, 8 m away.
  const Scenario scenario = load_scenario(
      std::string(HEDGEHOP_SOURCE_DIR) + "/configs/garratt2009_room_0.yaml",
      std::vector<std::string>{"avoidance={module: go_to_goal}", "goal={north: 30, east: 0, altitude: 1}",
                               "start={north: 0, east: 0, altitude: 1}", "film.enabled=false", "checks=[]",
                               "duration=30", "scene.texture_size=64", "drawing.renderer=tiles"});
  const Flight flight = Simulation(scenario).run();
  EXPECT_EQ(flight.result.outcome, Outcome::collided);
  EXPECT_NE(flight.result.cause.find("wall"), std::string::npos) << flight.result.cause;
  EXPECT_LE(flight.result.closest_obstacle.distance_m, 0.0);
}

TEST(Simulation, ASceneThatCannotBeIsBadInputWithItsReason) {
  try {
    Simulation(short_city({"scene.min_height=90"})).run();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "'scene.max_height': 40; valid: at least min_height");
  }
}

TEST(SimulationImage, AnUnknownCameraIsRefusedWithTheRigsRoles) {
  try {
    Simulation(short_city()).image("top", ImageChannel::grey);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "the rig has no camera 'top'; its cameras: left, right, front, rear, down");
  }
}

TEST(SimulationImage, ACameraThatTheContextCannotDrawIsRefusedByItsRole) {
  HEDGEHOP_REQUIRE_OSMESA();
  try {
    Simulation(short_city({"rig.cameras.1.samples=8", "drawing.renderer=osmesa"})).image("front", ImageChannel::grey);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "'rig.cameras.1.samples': 8 samples per pixel are not possible; maximum of this OpenGL: 4");
  }
}

TEST(SimulationImage, ShadowsDarkenPixelsAndBrightenNone) {
  const cv::Mat lit = Simulation(short_city()).image("down", ImageChannel::grey);
  const cv::Mat shaded = Simulation(short_city({"drawing.shadows=true"})).image("down", ImageChannel::grey);
  EXPECT_EQ(cv::countNonZero(shaded > lit), 0);
  EXPECT_GT(cv::countNonZero(shaded < lit), 0);
}

TEST(SimulationImage, GreyIsTheMeanOfColor) {
  const Scenario clean = short_city({"rig.sensor.use=sensors/ideal.yaml"});
  const cv::Mat color = Simulation(clean).image("front", ImageChannel::color);
  const cv::Mat grey = Simulation(clean).image("front", ImageChannel::grey);
  double largest = 0.0;
  for (int v = 0; v < grey.rows; ++v) {
    for (int u = 0; u < grey.cols; ++u) {
      const cv::Vec3b c = color.at<cv::Vec3b>(v, u);
      largest = std::max(largest, std::abs((c[0] + c[1] + c[2]) / 3.0 - grey.at<uint8_t>(v, u)));
    }
  }
  EXPECT_LE(largest, 1.5);  // both are rounded to whole levels, the textures too
}

TEST(SimulationImage, FlowToTheNextImageIsThatBetweenItsTwoPoses) {
  const Scenario ideal = short_city({"rig.sensor.use=sensors/ideal.yaml"});
  Simulation simulation(ideal);
  const auto pose = [&] {
    const TrueMotion motion = simulation.truth();
    return ChosenPose{Eigen::Translation3d(motion.p_WB) * motion.q_WB, simulation.t_s()};
  };
  simulation.fly_to(1.0);
  const ChosenPose before = pose();
  const cv::Mat flow = simulation.flow_to_next_image("front");
  EXPECT_NEAR(simulation.t_s(), 1.0 + 1.0 / 25.0, 1e-9) << "the camera has 25 Hz";
  EXPECT_GT(cv::norm(flow, cv::NORM_INF), 1.0);
  cv::Mat difference;
  cv::absdiff(flow, Simulation(ideal).flow_between("front", before, pose()), difference);
  constexpr double kMovedEdges = 2e-3;  // share; the quaternion rounds the pose
  EXPECT_LT(cv::countNonZero(difference.reshape(1) > 1e-2), kMovedEdges * 2.0 * static_cast<double>(flow.total()));
  simulation.fly_to(3.98);
  EXPECT_THROW(simulation.flow_to_next_image("front"), InputError) << "the flight ends after 4 s";
}

}  // namespace
}  // namespace hedgehop::sim
