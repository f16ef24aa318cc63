// Physics rates that a scenario gets if it states none.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;

const std::string kScenario = std::string(HEDGEHOP_SOURCE_DIR) + "/configs/shah2009_avoid.yaml";

Scenario scenario_at(double camera_hz, double imu_hz) {
  return load_scenario(kScenario, std::vector<std::string>{fmt::format("rig.cameras.0.rate={}", camera_hz),
                                                           fmt::format("avionics.imu.rate={}", imu_hz)});
}

constexpr int64_t kOthersHz = 100;  // all other rates divide it

TEST(PhysicsRate, IsTheSmallestThatAllRatesDivide) {
  for (const int64_t camera_hz : {10, 15, 24, 25, 30, 50, 60, 90, 120, 250}) {
    for (const int64_t imu_hz : {50, 100, 125, 200, 250, 400}) {
      int64_t smallest = 500;
      while (smallest <= 2000 && (smallest % camera_hz != 0 || smallest % imu_hz != 0 || smallest % kOthersHz != 0)) {
        ++smallest;
      }
      if (smallest > 2000) continue;
      EXPECT_EQ(scenario_at(static_cast<double>(camera_hz), static_cast<double>(imu_hz)).physics_rate_hz, smallest)
          << camera_hz << " and " << imu_hz << " Hz";
    }
  }
  EXPECT_EQ(scenario_at(30, 200).physics_rate_hz, 600);
  EXPECT_EQ(scenario_at(90, 50).physics_rate_hz, 900);
  EXPECT_EQ(scenario_at(12.5, 100).physics_rate_hz, 500);
}

TEST(PhysicsRate, ARateThatFitsNoneIsRefusedWithTheNearestThatFit) {
  EXPECT_THAT(
      faults_of([] { scenario_at(29.97, 50); }),
      ElementsAre("--set rig.cameras.0.rate: 'rig.cameras.0.rate': 29.97 Hz and the other rates (5, 50, 100 Hz) do "
                  "not divide one physics rate from 500 to 2000 Hz; the nearest that do: 29.6875 and 30 Hz"));
  EXPECT_NO_THROW(scenario_at(29.6875, 50));
  EXPECT_EQ(faults_of([] { scenario_at(100, 333); }).size(), 1U);
}

TEST(PhysicsRate, OfTheScenariosWithoutALinkIs500Hz) {
  for (const auto& file : scenarios_in({".", "worlds"})) EXPECT_EQ(load_scenario(file).physics_rate_hz, 500) << file;
}

TEST(PhysicsRate, OneErrorForTheCamerasOfAPair) {
  const auto stereo = std::string(HEDGEHOP_SOURCE_DIR) + "/configs/perez2018_route_light.yaml";
  EXPECT_EQ(faults_of([&] { load_scenario(stereo, std::vector<std::string>{"rig.stereo.0.rate=29.97"}); }).size(), 1U);
}

TEST(PhysicsRate, DoesNotDependOnTheFilm) {
  EXPECT_THAT(
      faults_of([] { load_scenario(kScenario, std::vector<std::string>{"film.rate=24"}); }),
      ElementsAre("--set film.rate: 'film.rate': 24 Hz does not divide the physics rate of 500 Hz; the nearest that "
                  "do: 20 and 25 Hz"));
}

}  // namespace
}  // namespace hedgehop::sim
