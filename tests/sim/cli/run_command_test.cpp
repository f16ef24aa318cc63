#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kScenario =
    "name: blind\nduration: 0.2\nscene: {type: corridor, width: 10, sections: [{length: 40}]}\n"
    "velocimeter: {enabled: false}\nvehicle: {use: " HEDGEHOP_SOURCE_DIR
    "/configs/vehicles/hummingbird.yaml}\nstart: {north: 5, east: 0, altitude: 1.5, heading: 0}\n"
    "goal: {north: 35, east: 0, altitude: 1.5, radius: 1}\navoidance: {module: go_to_goal, speed: 1}\n"
    "checks: [{check: no_collision}]\n";

TEST(RunCommand, PrintsThatCommandsWereAtTheSpeedLimit) {
  const CampaignFolder folder;
  folder.write("blind.yaml", kScenario);
  EXPECT_THAT(folder.hedgehop("run blind.yaml --no-report --set avoidance.speed=4").out,
              HasSubstr("avionics.autopilot.speed_limit is 3 m/s"));
  EXPECT_THAT(folder.hedgehop("run blind.yaml --no-report").out, Not(HasSubstr("speed_limit")));
}

TEST(RunCommand, RemovesTheFilmOfAnEarlierFlightIfThereAreNoImages) {
  const CampaignFolder folder;
  folder.write("blind.yaml", kScenario);
  std::filesystem::create_directories(folder.path() / "out");
  folder.write("out/video.webm", "old");
  const CommandEnd end = folder.hedgehop("run blind.yaml --out out");
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/video.webm"));
}

TEST(RunCommand, PrintsBothPercentilesOfWallTimes) {
  const CampaignFolder folder;
  EXPECT_THAT(folder.hedgehop("run tiny.yaml --no-video --no-report --out out").out,
              testing::ContainsRegex("median and 95th percentile: drawing [0-9.]+ and [0-9.]+ ms per image instant, "
                                     "deciding [0-9.]+ and [0-9.]+ ms per decision\n"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
