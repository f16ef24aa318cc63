#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>
#include <utility>

#include "sim/config/outline_texts.h"
#include "sim/loop/active_module.h"
#include "sim/scenario/avoidance_choice.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

constexpr double kDurationS = 2.0, kAtS = 0.9;

/// Two seconds with a module of the tree, in a scenario that suits it.
struct ModuleFlight {
  std::string module, file;
  std::vector<std::string> overrides;  ///< of the file
};

std::vector<ModuleFlight> module_flights() {
  const std::vector<std::string> day{"vehicle.use=../../vehicles/s900.yaml", "avionics.autopilot.speed_limit=2.235"};
  const auto leaderboard = [&](const std::string& rig, const std::string& module) {
    std::vector<std::string> overrides = day;
    overrides.push_back("rig.use=../../rigs/" + rig + ".yaml");
    overrides.push_back("velocimeter.enabled=false");
    overrides.push_back("avoidance.use=../modules/" + module + ".yaml");
    return overrides;
  };
  return {{"go_to_goal", "perez2018_control.yaml", {}},
          {"flow_balance", "garratt2009_city_0_light.yaml", {}},
          {"zig_zag", "garratt2009_room_0_light.yaml", {}},
          {"section_grid", "perez2018_route_light.yaml", {}},
          {"stereo_corridor", "andert2007_tree_160.yaml", {}},
          {"corridor_centering", "zingg2010_corridor_4m.yaml", {}},
          {"landmark_map", "shah2009_avoid.yaml", {}},
          {"local_map", "leaderboard/worlds/tree.yaml", leaderboard("local_map", "local_map")},
          {"onnx_policy", "leaderboard/worlds/tree.yaml", leaderboard("perez2018_640", "cloned_policy")}};
}

Scenario scenario_of(const ModuleFlight& flight) {
  std::vector<std::string> overrides = flight.overrides;
  overrides.insert(overrides.end(), {"duration=" + std::to_string(kDurationS), "film.enabled=false", "checks=[]",
                                     "drawing.renderer=tiles", "scene.texture_size=128"});
  return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/" + flight.file, overrides);
}

Flight fly(const Scenario& scenario) { return Simulation(scenario).run(); }

class TakeoverOf : public ::testing::TestWithParam<ModuleFlight> {};

TEST_P(TakeoverOf, EqualModuleIsTheUnbrokenFlight) {
  const Scenario scenario = scenario_of(GetParam());
  Scenario branched = scenario;
  branched.takeover = TakeoverConfig{.at_s = kAtS, .avoidance = scenario.avoidance};
  const Flight unbroken = fly(scenario), branch = fly(branched);
  EXPECT_EQ(branch.result.trajectory_hash, unbroken.result.trajectory_hash);
  ASSERT_EQ(branch.decisions.size(), unbroken.decisions.size());
  for (size_t i = 0; i < branch.decisions.size(); ++i) {
    EXPECT_EQ(branch.decisions[i].status, unbroken.decisions[i].status);
    EXPECT_THAT(branch.decisions[i].signals,
                ::testing::Pointwise(::testing::NanSensitiveDoubleEq(), unbroken.decisions[i].signals));
  }
}

std::string name_of(const ::testing::TestParamInfo<ModuleFlight>& info) { return info.param.module; }
INSTANTIATE_TEST_SUITE_P(EachModule, TakeoverOf, ::testing::ValuesIn(module_flights()), name_of);

TEST(Takeover, EveryModuleOfTheTreeIsTried) {
  std::set<std::string> tried, known;
  for (const ModuleFlight& flight : module_flights()) tried.insert(flight.module);
  fields::for_each_alternative<avoidance::ModuleConfig>([&]<class C>() { known.insert(std::string(C::kName)); });
  EXPECT_EQ(tried, known);
}

/// From the moment on the flight is another one, and before it is not.
TEST(Takeover, OtherSettingsChangeTheFlightFromTheMomentOnly) {
  const Scenario scenario = scenario_of(module_flights().front());
  Scenario branched = scenario;
  branched.takeover =
      TakeoverConfig{.at_s = kAtS, .avoidance = AvoidanceConfig::Choice{avoidance::GoToGoalConfig{.speed_mps = 0.5}}};
  const Flight unbroken = fly(scenario), branch = fly(branched);
  size_t equal = 0;
  while (equal < branch.trajectory.size() &&
         branch.trajectory[equal].p_WB_true == unbroken.trajectory[equal].p_WB_true) {
    ++equal;
  }
  ASSERT_LT(equal, branch.trajectory.size());
  EXPECT_GE(branch.trajectory[equal].t_s, kAtS + branch.command_latency_s);
  EXPECT_LT(branch.trajectory[equal].t_s, kAtS + branch.command_latency_s + 0.2);
}

TEST(Takeover, OtherCamerasAndALateMomentAreRefused) {
  Scenario scenario = scenario_of(module_flights()[1]);
  scenario.takeover = TakeoverConfig{.at_s = kAtS, .avoidance = AvoidanceConfig()};
  EXPECT_THAT([&] { fly(scenario); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("'takeover.avoidance': needs other cameras")));
  EXPECT_THAT(
      [] {
        load_scenario(HEDGEHOP_SOURCE_DIR "/configs/perez2018_control.yaml",
                      std::vector<std::string>{"takeover={at: 500, avoidance: {module: go_to_goal}}"});
      },
      ::testing::ThrowsMessage<InputError>(HasSubstr("'takeover.at': must be before the end of the flight (180 s)")));
}

TEST(Takeover, ErrorOfItsForeignModuleNamesTheTakeover) {
  for (const auto& [text, path] : {std::pair("{plugin: absent.so, module: mine}", "'takeover.avoidance.plugin'"),
                                   std::pair("{python: absent.py, class: Mine}", "'takeover.avoidance.python'")}) {
    EXPECT_THAT(
        [&] {
          fly(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/perez2018_control.yaml",
                            std::vector<std::string>{fmt::format("takeover={{at: 1, avoidance: {}}}", text)}));
        },
        ::testing::ThrowsMessage<InputError>(HasSubstr(path)));
  }
}

}  // namespace
}  // namespace hedgehop::sim
