#include "sim/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/config/config_outline.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ShippedScenarios, LoadAndBearTheNameOfTheirFile) {
  const auto files = scenarios_in({"."});
  EXPECT_GE(files.size(), 60u);
  for (const auto& file : files) EXPECT_EQ(load_scenario(file).name, file.stem().string());
}

TEST(ShippedScenarios, LayTheirVariantsOver) {
  const Scenario city = load_scenario(kConfigs / "garratt2009_city_0.yaml");
  EXPECT_EQ(city.start.p_WB(), Eigen::Vector3d(-130.0, 80.0, -10.0));
  EXPECT_EQ(city.goal.value().p_WG(), Eigen::Vector3d(110.0, -110.0, -10.0));
  EXPECT_EQ(city.rig.cameras.size(), 5u);
  EXPECT_EQ(city.rig.cameras[0].rate_hz, 50.0);

  const Scenario light = load_scenario(kConfigs / "garratt2009_city_22_light.yaml");
  EXPECT_NEAR(light.start.heading_rad, 0.39269908169872414, 1e-15);
  EXPECT_EQ(light.start.p_WB(), city.start.p_WB());
  EXPECT_EQ(light.rig.cameras[0].width_px, 200);
  EXPECT_EQ(light.rig.cameras[0].rate_hz, 25.0);

  const Scenario control = load_scenario(kConfigs / "garratt2009_city_45_control.yaml");
  EXPECT_EQ(control.avoidance.name(), "go_to_goal");
  EXPECT_FALSE(load_scenario(kConfigs / "garratt2009_room_22.yaml").goal);
}

TEST(Scenario, EqualInputGivesEqualText) {
  const auto file = kConfigs / "garratt2009_city_0.yaml";
  EXPECT_EQ(to_yaml(load_scenario(file)), to_yaml(load_scenario(file)));
}

TEST(Scenario, AReferenceIsRelativeToTheFileThatNamesIt) {
  const Folder folder;
  const std::string path = "t_s,north_m,east_m,altitude_m\n0,0,0,1\n";
  const std::string check = "checks: [{check: path_tolerance, reference: ref.csv, at_most: 1}]";
  Folder::write("sub/ref.csv", path);
  Folder::write("sub/base.yaml", "use: " + (kConfigs / "garratt2009_city_0.yaml").string() + "\n" + check + "\n");
  Folder::write("outer.yaml", "use: sub/base.yaml\n");
  const auto reference = [](const std::vector<std::string>& overrides) {
    return std::filesystem::relative(
               std::get<PathToleranceCheck>(load_scenario("outer.yaml", overrides).checks.at(0)).reference)
        .string();
  };
  EXPECT_EQ(reference({}), "sub/ref.csv");
  Folder::write("ref.csv", path);
  EXPECT_EQ(reference({}), "sub/ref.csv");
  EXPECT_EQ(reference({"checks=" + check.substr(8)}), "ref.csv");  // relative to the scenario's folder
}

TEST(Scenario, AFormulaOfTheGoalDistanceNeedsAGoal) {
  const std::string check = "checks=[{check: formula, name: f, formula: 'eventually (goal_distance < 0.5)'}]";
  EXPECT_NO_THROW(load_scenario(kConfigs / "garratt2009_city_0.yaml", std::vector<std::string>{check}));
  try {
    load_scenario(kConfigs / "garratt2009_room_0.yaml", std::vector<std::string>{check});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("uses 'goal_distance', but the scenario has no goal"));
  }
}

TEST(Renamed, KeysOfAnEarlierVersionAreRefusedWithTheirNewName) {
  struct Row {
    std::string scenario, override, now;
  };
  for (const Row& row : {Row{"garratt2009_city_0.yaml", "drawing.gl=tiles", "renderer"},
                         Row{"garratt2009_city_0.yaml", "drawing.context=tiles", "renderer"},
                         Row{"shah2009_avoid.yaml", "avoidance.front_end=images", "source"},
                         Row{"shah2009_avoid.yaml", "avoidance.map.young_misses=3", "unconfirmed_misses"},
                         Row{"perez2018_route_light.yaml", "avoidance.sight=truth", "depth"},
                         Row{"perez2018_route_light.yaml", "avoidance.rows=9", "sections"},
                         Row{"perez2018_route_light.yaml", "avoidance.cols=9", "sections"},
                         Row{"perez2018_route_light.yaml", "avoidance.passed={radius: 2}", "passed_radius"}}) {
    EXPECT_THAT(faults_of([&] { load_scenario(kConfigs / row.scenario, std::vector{row.override}); }),
                ElementsAre(testing::EndsWith("; its name is now '" + row.now + "'")))
        << row.override;
  }
  for (const auto& [law, now] : {std::pair<std::string, std::string>{"printed", "published"}, {"ours", "modified"}}) {
    for (const std::string path : {"avoidance", "takeover.avoidance"}) {
      const std::string set = path == "avoidance"
                                  ? "avoidance.law=" + law
                                  : "takeover={at: 1, avoidance: {module: flow_balance, law: " + law + "}}";
      EXPECT_THAT(faults_of([&] { load_scenario(kConfigs / "garratt2009_city_0.yaml", std::vector{set}); }),
                  ElementsAre(testing::EndsWith("unknown choice '" + law + "' for '" + path +
                                                ".law'; its name is now '" + now + "'")));
    }
  }
  EXPECT_THAT(faults_of([] {
                load_scenario(kConfigs / "garratt2009_city_0.yaml",
                              std::vector<std::string>{"avoidance.scheme=simple"});
              }),
              ElementsAre(testing::EndsWith("unknown key 'scheme' in 'avoidance'; it was removed; `scheme: simple` is "
                                            "now `module: zig_zag`")));
  // No new name that the module does not have.
  EXPECT_THAT(faults_of([] {
                load_scenario(kConfigs / "garratt2009_city_0.yaml", std::vector<std::string>{"avoidance.rows=9"});
              }),
              ElementsAre(HasSubstr("unknown key 'rows' in 'avoidance'; allowed: ")));
}

TEST(Removed, KeyChanceNamesItsReplacement) {
  EXPECT_THAT(faults_of([] {
                load_scenario(kConfigs / "garratt2009_city_0.yaml", std::vector<std::string>{"chance=[{seed: 1}]"});
              }),
              ElementsAre(HasSubstr("unknown key 'chance' in the scenario; it was removed with `hedgehop estimate`; to "
                                    "bound a rate, use `hedgehop batch --until`")));
}

/// Contradictions in a scenario that is otherwise valid.
class CrossRules : public testing::Test {
 protected:
  /// Numbers that messages repeat are set here: the shipped ones may be tuned.
  static std::vector<std::string> faults(const std::vector<std::string>& overrides) {
    std::vector<std::string> all = {"physics_rate=500", "duration=400", "goal.radius=5"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return faults_of([&] { load_scenario(kConfigs / "garratt2009_city_0.yaml", all); });
  }
};

TEST_F(CrossRules, NoFaultWithoutOverrides) { EXPECT_THAT(faults({}), ElementsAre()); }

TEST_F(CrossRules, CameraRolesAreUnique) {
  EXPECT_THAT(
      faults({"rig.cameras.2.role=left"}),
      testing::Contains("--set rig.cameras.2.role: 'rig.cameras.2.role': 'rig.cameras.0' has the role 'left' already"));
  EXPECT_THAT(faults({"rig.stereo=[{role: rear}, {baseline: 0.1}]"}),
              testing::Contains("--set rig.stereo: 'rig.stereo.1.role': 'rig.cameras.0' has the role 'left' already"));
}

TEST_F(CrossRules, RatesDivideThePhysicsRate) {
  EXPECT_THAT(
      faults({"rig.cameras.2.rate=30", "control_rate=99", "film.rate=7"}),
      testing::UnorderedElementsAre(
          "--set rig.cameras.2.rate: 'rig.cameras.2.rate': 30 Hz does not divide the physics rate of 500 Hz; the "
          "nearest that do: 25 and 31.25 Hz; without 'physics_rate', a rate is chosen",
          "--set control_rate: 'control_rate': 99 Hz does not divide the physics rate of 500 Hz; the nearest that do: "
          "62.5 and 100 Hz; without 'physics_rate', a rate is chosen",
          "--set film.rate: 'film.rate': 7 Hz does not divide the physics rate of 500 Hz; the nearest that do: "
          "6.25 and 7.8125 Hz; without 'physics_rate', a rate is chosen"));
}

TEST_F(CrossRules, TheRigHasTheRequiredCameras) {
  EXPECT_THAT(
      faults({"velocimeter.camera=dwn"}),
      ElementsAre("--set velocimeter.camera: 'velocimeter.camera': needs a camera 'dwn', which the rig does not "
                  "have; it has: left, right, front, rear, down. Mount one, name another, or fly with "
                  "'velocimeter.enabled: false'"));
  EXPECT_THAT(
      faults({"rig.cameras.0.role=port"}),
      testing::Contains(HasSubstr("'avoidance': needs a camera 'left', which the rig does not have; it has: port")));
  EXPECT_THAT(faults({"rig.cameras.0.channel=depth"}),
              testing::Contains(
                  HasSubstr("'avoidance': needs camera 'left' to deliver grey images; it delivers depth images")));
}

TEST_F(CrossRules, NoImperfectionIsSilentlyWithoutEffect) {
  EXPECT_THAT(
      faults({"rig.cameras.0.imperfections.disparity_noise=1"}),
      testing::Contains(HasSubstr("'rig.cameras.0.imperfections.disparity_noise': is for channel: depth alone")));
  for (const std::string key :
       {"vignetting", "exposure", "auto_exposure", "full_well", "read_noise", "fixed_pattern", "shutter"}) {
    EXPECT_THAT(faults({"rig.cameras.0.channel=depth", "rig.cameras.0.imperfections." + key + "=0.5"}),
                testing::Contains(HasSubstr("'rig.cameras.0.imperfections." + key + "': is not for depth images")));
  }
  EXPECT_THAT(faults({"rig.cameras.0.channel=depth", "rig.cameras.0.model=fisheye",
                      "rig.cameras.0.imperfections.disparity_noise=1"}),
              testing::Contains(HasSubstr("disparity_noise': needs an undistorted pinhole")));
  EXPECT_THAT(faults({"rig.cameras.0.channel=depth", "rig.cameras.0.imperfections.disparity_noise=1",
                      "rig.cameras.0.imperfections.drop=0.1", "rig.cameras.0.imperfections.readout=0.01"}),
              testing::Not(testing::Contains(HasSubstr("imperfections"))));
}

TEST_F(CrossRules, ChecksMakeSense) {
  EXPECT_THAT(faults({"goal=~"}), testing::Contains(HasSubstr("'checks.0': the scenario has no goal to reach")));
  EXPECT_THAT(faults({"checks=[{check: altitude_band, min: 3, max: 2}]"}),
              ElementsAre("--set checks: 'checks.0.max': must be greater than 'min' (3 m), got 2"));
  EXPECT_THAT(faults({"altitude_band={min: 9, max: 8}"}),
              ElementsAre(HasSubstr("'altitude_band.max': must be greater than 'min' (9 m), got 8")));
  EXPECT_THAT(faults({"altitude_band={min: 90, max: 99}"}),
              ElementsAre(HasSubstr("m is outside the altitude_band, 90 to 99 m")));
  EXPECT_THAT(
      faults({"checks=[{check: min_clearance, at_least: 50.1}]"}),
      ElementsAre(HasSubstr("'checks.0.at_least': 50.1 m is beyond the distance up to which obstacles are known")));
  EXPECT_THAT(faults({"checks=[{check: min_clearance, at_least: 50.1, to: ground}]"}), testing::IsEmpty());
  EXPECT_THAT(faults({"checks=[{check: no_collision}]", "may_collide=true"}),
              ElementsAre("--set checks: 'checks.0': contradicts 'may_collide: true'"));
  EXPECT_THAT(faults({"checks=[{check: metric, name: jerk_rmss, at_most: 1}]"}),
              ElementsAre(HasSubstr("'checks.0.name': is not a metric; did you mean 'jerk_rms'? allowed: success, ")));
  EXPECT_THAT(faults({"checks=[{check: metric, name: jerk_rms, at_most: -1}]"}),
              ElementsAre("--set checks: 'checks.0.at_most': must be >= 0, because jerk_rms is never negative"));
  EXPECT_THAT(faults({"checks=[{check: metric, name: path_excess, at_most: -1}]"}), testing::IsEmpty());
  EXPECT_THAT(faults({"checks=[{check: metric, name: module.a}]"}),
              ElementsAre("--set checks: 'checks.0': needs 'at_least' or 'at_most'"));
  EXPECT_THAT(
      faults({"checks=[{check: reached_goal, within: 4, before: 500}]"}),
      ElementsAre("--set checks: 'checks.0.within': is less than the goal's radius (5 m), at which the flight ends",
                  "--set checks: 'checks.0.before': is after the end of the flight (400 s)"));
}

/// Keys of all lengths below an outline; not those in lists, which an override sets as a whole if no file does.
void collect_lengths(const ConfigOutline& node, const std::string& path, std::vector<std::string>& keys) {
  if (node.kind == ConfigOutline::Kind::list || !node.present) return;
  if (node.kind == ConfigOutline::Kind::number && node.field.unit == "m") keys.push_back(path);
  size_t index = 0;
  for (const ConfigOutline& part : node.parts) {
    collect_lengths(part, join_path(path, part.key.empty() ? std::to_string(index++) : part.key), keys);
  }
}

TEST(Scenario, RefusesALengthBeyondAnyWorldByItsPlace) {
  const auto file = kConfigs / "garratt2009_room_0_light.yaml";
  std::vector<std::string> keys;
  collect_lengths(outline(load_scenario(file), {}), "", keys);
  ASSERT_GT(keys.size(), 30u);
  for (const std::string& key : keys) {
    EXPECT_THAT(faults_of([&] { load_scenario(file, std::vector<std::string>{key + "=1e308"}); }),
                testing::Contains(testing::AllOf(HasSubstr("--set " + key + ": '" + key + "': must be <"),
                                                 HasSubstr(" m, got 1e308"))));
  }
}

TEST_F(CrossRules, AGoalNeedsItsWholePosition) {
  const std::vector<std::string> found =
      faults_of([] { load_scenario(kConfigs / "garratt2009_room_0.yaml", std::vector<std::string>{"goal.north=3"}); });
  EXPECT_THAT(found,
              ElementsAre(HasSubstr("missing key 'east' in 'goal'"), HasSubstr("missing key 'altitude' in 'goal'")));
}

TEST(BuildPart, TurnsInvalidArgumentIntoInputError) {
  EXPECT_EQ(build_part("scene", [] { return 3; }), 3);
  EXPECT_THAT(faults_of([] { build_part("scene", []() -> int { throw std::invalid_argument("too small"); }); }),
              ElementsAre("'scene': too small"));
}

TEST(Start, IsDrawnEvenlyFromTheDisc) {
  StartConfig start;
  start.north_m = 3.0;
  start.altitude_m = 2.0;
  start.spread_m = 4.0;
  constexpr int kDraws = 20'000;
  int inner = 0;
  for (uint64_t seed = 0; seed < kDraws; ++seed) {
    const Eigen::Vector3d offset = start.draw_p_WB(seed) - start.p_WB();
    EXPECT_EQ(offset.z(), 0.0);
    ASSERT_LE(offset.norm(), 4.0);
    inner += offset.norm() < 2.0;
  }
  EXPECT_NEAR(static_cast<double>(inner) / kDraws, 0.25, 0.012);  // four standard deviations
  EXPECT_EQ(start.draw_p_WB(5), start.draw_p_WB(5));
  start.spread_m = 0.0;
  EXPECT_EQ(start.draw_p_WB(5), start.p_WB());
}

}  // namespace
}  // namespace hedgehop::sim
