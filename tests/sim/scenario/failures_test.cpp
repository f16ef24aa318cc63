#include "sim/scenario/failures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Errors of the light city with failures, in flow style.
std::vector<std::string> faults_with(const std::string& failures) {
  return faults_of([&] {
    load_scenario(kConfigs / "garratt2009_city_0_light.yaml", std::vector<std::string>{"failures=" + failures});
  });
}

TEST(Failures, ThatFitAreReadAndWrittenBack) {
  const Scenario scenario = load_scenario(
      kConfigs / "garratt2009_city_0_light.yaml",
      std::vector<std::string>{"failures=[{at: 20, what: gps, mode: bias, value: 2, axis: y, until: 22.5}, "
                               "{at: 1, what: camera.front, mode: black}, {at: 3, what: servo.tail, mode: stuck}]"});
  ASSERT_EQ(scenario.failures.size(), 3u);
  EXPECT_EQ(to_text(scenario.failures[0]), "20 s to 22.5 s: gps bias 2");
  EXPECT_EQ(to_text(scenario.failures[1]), "1 s to the end: camera.front black");
  EXPECT_FALSE(scenario.failures[0].holds(19'999'999'999));
  EXPECT_TRUE(scenario.failures[0].holds(20'000'000'000));
  EXPECT_FALSE(scenario.failures[0].holds(22'500'000'000));
  EXPECT_THAT(to_yaml(scenario), HasSubstr("what: servo.tail"));
}

TEST(Failures, OfUnknownThingsNameTheNearest) {
  EXPECT_THAT(faults_with("[{at: 1, what: camera.fornt, mode: off}]"),
              ElementsAre(HasSubstr("'failures.0.what': unknown device 'camera.fornt'; did you mean "
                                    "'camera.front'?")));
  EXPECT_THAT(faults_with("[{at: 1, what: motor.0, mode: off}]"),
              ElementsAre(HasSubstr("'motor.0' is not on board")));  // of a helicopter
}

TEST(Failures, OfInstrumentsThatAreNotOnBoardHaveNoEffectAndAreRefused) {
  for (const std::string what : {"barometer", "range_finder"}) {
    EXPECT_THAT(faults_with("[{at: 1, what: " + what + ", mode: off}]"),
                ElementsAre(HasSubstr("'" + what + "' is not on board or is not used")));
  }
}

TEST(Failures, MustFitTheirTimesModesAndValues) {
  EXPECT_THAT(faults_with("[{at: 1e4, what: gps, mode: off}]"),
              ElementsAre(HasSubstr("must be before the end of the flight")));
  EXPECT_THAT(faults_with("[{at: 5, until: 5, what: gps, mode: off}]"),
              ElementsAre(HasSubstr("greater than 'at' (5 s)")));
  EXPECT_THAT(faults_with("[{at: 5, what: gps, mode: black}]"),
              ElementsAre(HasSubstr("'failures.0.mode': is not for gps; allowed: off, stuck, bias, noise")));
  EXPECT_THAT(faults_with("[{at: 5, what: gps, mode: bias}]"), ElementsAre(HasSubstr("bias needs a 'value'")));
  EXPECT_THAT(faults_with("[{at: 5, what: gps, mode: off, value: 1}]"), ElementsAre(HasSubstr("is not for mode off")));
  EXPECT_THAT(faults_with("[{at: 5, what: gps, mode: noise, value: -1}]"),
              ElementsAre(HasSubstr("at least 0, got -1")));
  EXPECT_THAT(faults_with("[{at: 5, what: height_sensor, mode: bias, value: 1, axis: y}]"),
              ElementsAre(HasSubstr("'y' is not an axis of height_sensor bias; valid: x")));
}

TEST(Failures, OfOneThingMustNotOverlap) {
  EXPECT_THAT(faults_with("[{at: 1, what: gps, mode: off, until: 3}, {at: 2, what: gps, mode: stuck}]"),
              ElementsAre(HasSubstr("'failures.1.at': gps fails already then, by failure 0")));
  EXPECT_THAT(faults_with("[{at: 1, what: gps, mode: off, until: 2}, {at: 2, what: gps, mode: stuck}]"), ElementsAre());
}

TEST(StereoPairs, ThatAreNotParallelOrUnequalInRateAreRefusedWithAPlace) {
  const auto faults = [](const std::string& key) {
    return faults_of([&] {
      load_scenario(kConfigs / "andert2007_forest.yaml",
                    std::vector<std::string>{
                        "rig={cameras: [{role: left, width: 320, height: 240, fov: 60, rate: 10, right: -0.15}, "
                        "{role: right, width: 320, height: 240, fov: 60, rate: 10, right: 0.15}]}",
                        key});
    });
  };
  EXPECT_THAT(faults("rig.cameras.0.rate=10"), ElementsAre());
  EXPECT_THAT(faults("rig.cameras.1.yaw=5"), ElementsAre(HasSubstr("'avoidance': ")));
  EXPECT_THAT(faults("rig.cameras.1.rate=5"), ElementsAre(HasSubstr("'avoidance': ")));
  EXPECT_THAT(faults("rig.cameras.1.rate=5"), ElementsAre(testing::MatchesRegex(".*andert2007_forest.yaml:[0-9]+:.*")));
}

}  // namespace
}  // namespace hedgehop::sim
