// Every example world loads, is seen, and is flown in.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/simulation/simulation.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

TEST(ExampleWorlds, AreSeenAndFlownInForASecondUnharmed) {
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs/worlds")) {
    ++worlds;
    const std::vector<std::string> overrides = {"duration=1", "scene.texture_size=64", "drawing.renderer=tiles"};
    const Scenario scenario = load_scenario(entry.path(), overrides);
    cv::Scalar mean, deviation;
    cv::meanStdDev(Simulation(scenario).image("front", ImageChannel::grey), mean, deviation);
    EXPECT_GT(deviation[0], 10.0) << entry.path();
    const Flight flight = Simulation(scenario).run();
    EXPECT_EQ(flight.result.outcome, Outcome::timeout) << entry.path() << ": " << flight.result.cause;
  }
  EXPECT_EQ(worlds, 7);
}

TEST(ExampleWorlds, TheTreeOnTheWayIsHit) {
  const std::vector<std::string> overrides = {"scene.texture_size=64", "drawing.renderer=tiles", "avoidance.speed=5"};
  const Flight flight = Simulation(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/worlds/tree.yaml", overrides)).run();
  EXPECT_EQ(flight.result.outcome, Outcome::collided);
  EXPECT_EQ(flight.result.closest_obstacle.what, "tree");
  EXPECT_NEAR(flight.result.closest_obstacle.p_WB_true.x(), -5.0, 1.5);  // the crown's south side, less the rotor
}

TEST(ExampleWorlds, TellHowCrampedTheyAreAtTheHeightOfTheStart) {
  const std::vector<std::string> overrides = {"duration=0.1", "scene.texture_size=64", "drawing.renderer=tiles"};
  const Flight flight = Simulation(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/worlds/forest.yaml", overrides)).run();
  EXPECT_NEAR(flight.result.scene.density_pm2, 1.0 / 32.0, 1e-9);  // a tree to every 2 x (4 m)^2
  EXPECT_GT(flight.result.scene.median_gap_m, flight.result.scene.smallest_gap_m);
}

TEST(Imports, ThatCannotBeReadAreRefusedWithTheirPlace) {
  const std::vector<std::string> overrides = {"scene.imports=[{file: /no/such.obj}]"};
  try {
    load_scenario(HEDGEHOP_SOURCE_DIR "/configs/worlds/tree.yaml", overrides);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("imports"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("there is no such file"), std::string::npos) << error.what();
  }
}

TEST(Imports, AreReadOnceForTheValidationAndTheFlight) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "read_once.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n";
  const std::vector<std::string> overrides = {
      "scene.imports=[{file: '" + file.string() + "', name: sheet, north: 50, altitude: 20}]", "scene.texture_size=64",
      "drawing.renderer=tiles"};
  LoadedScenario loaded = load_flight(HEDGEHOP_SOURCE_DIR "/configs/worlds/tree.yaml", overrides);
  EXPECT_EQ(loaded.parts.files.remarks, (std::vector{"'" + file.string() + "': 0 x 1 x 1 m (north, east, up)",
                                                     "'" + file.string() + "': not rendered: points and lines"}));
  std::filesystem::remove(file);
  const Simulation simulation(std::move(loaded));
  const scenes::Scene& scene = simulation.scene();
  EXPECT_EQ(scene.solids.back().name, "sheet");
  for (const scenes::Vertex& vertex : scene.meshes.back().vertices)
    EXPECT_EQ(vertex.texture + 1, scene.textures.size());
  EXPECT_EQ(scene.textures.images().back().at<cv::Vec3b>(0, 0), cv::Vec3b(153, 153, 153));  // Kd 0.6
}

}  // namespace
}  // namespace hedgehop::sim
