#include "sim/config/other_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/config/include.h"
#include "sim/config/numbers.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

constexpr double kRadpsOf870Rpm = 91.106186954104;

/// Returns main_rotor.speed of a text with overrides, rad/s; NaN if it is missing.
double speed_radps(const std::string& yaml, const std::vector<std::string>& overrides, ErrorList& errors) {
  std::set<std::filesystem::path> read;
  Node root = parse_tree(yaml, "vehicle", errors, read);
  apply_overrides(root, overrides, "vehicle.yaml", errors, read);
  const Node* const rotor = root.find("main_rotor");
  const Node* const speed = rotor ? rotor->find("speed") : nullptr;
  return speed ? parse_number(speed->text, false).member : std::nan("");
}
double speed_radps(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  ErrorList errors("vehicle");
  const double speed = speed_radps(yaml, overrides, errors);
  EXPECT_TRUE(errors.empty()) << yaml;
  return speed;
}

TEST(OtherUnits, RpmStandsForTheRotorSpeed) {
  EXPECT_NEAR(speed_radps("main_rotor: {rpm: 870}"), kRadpsOf870Rpm, 1e-9);
  EXPECT_NEAR(speed_radps("main_rotor: {radius: 1}", {"main_rotor.rpm=870"}), kRadpsOf870Rpm, 1e-9);
  EXPECT_NEAR(speed_radps("a: 1", {"main_rotor={rpm: 870}"}), kRadpsOf870Rpm, 1e-9);
}

TEST(OtherUnits, TheLaterKeyOverridesTheEarlier) {
  EXPECT_NEAR(speed_radps("main_rotor: {speed: 100}", {"main_rotor.rpm=870"}), kRadpsOf870Rpm, 1e-9);
  EXPECT_NEAR(speed_radps("main_rotor: {rpm: 870}", {"main_rotor.speed=100"}), 100.0, 1e-9);
  const TemporaryFolder folder;
  const std::filesystem::path base = folder.path() / "base.yaml";
  std::ofstream(base) << "main_rotor: {speed: 100}\n";
  EXPECT_NEAR(speed_radps("use: " + base.string() + "\nmain_rotor: {rpm: 870}"), kRadpsOf870Rpm, 1e-9);
}

TEST(OtherUnits, BothKeysInOneMapAreAnError) {
  ErrorList errors("vehicle");
  speed_radps("main_rotor: {speed: 100, rpm: 870}", {}, errors);
  EXPECT_EQ(errors.count(), 1u);
}

TEST(OtherUnits, KeysOfOtherMapsAreNotChanged) {
  ErrorList errors("vehicle");
  std::set<std::filesystem::path> read;
  const Node root = parse_tree("parameters: {rpm: 870}", "vehicle", errors, read);
  ASSERT_NE(root.find("parameters")->find("rpm"), nullptr);
  EXPECT_EQ(root.find("parameters")->find("rpm")->text, "870");
}

// Their names and units are the module's own.
TEST(OtherUnits, ParametersOfForeignModulesAreNotChanged) {
  const TemporaryFolder folder;
  const std::filesystem::path base = folder.path() / "parameters.yaml";
  std::ofstream(base) << "main_rotor: {rpm: 1500}\n";
  const std::filesystem::path rotor_file = folder.path() / "rotor.yaml";
  std::ofstream(rotor_file) << "rpm: 1500\n";
  const std::string use_rotor = "{main_rotor: {use: " + rotor_file.string() + "}}";
  const std::string module = "avoidance: {python: a.py, class: A", map = ", parameters: {main_rotor: {rpm: 1500}}}";
  for (const auto& [yaml, change] : std::vector<std::pair<std::string, std::string>>{
           {module + map, "a=1"},
           {module + ", parameters: {use: " + base.string() + "}}", "a=1"},
           {module + ", parameters: " + use_rotor + "}", "a=1"},
           {module + "}", "avoidance.parameters=" + use_rotor},
           {module + "}", "avoidance.parameters.main_rotor.use=" + rotor_file.string()},
           {module + "}", "avoidance.parameters={main_rotor: {rpm: 1500}}"},
           {module + "}", "avoidance.parameters.main_rotor.rpm=1500"},
           {module + "}", "avoidance.parameters.main_rotor={rpm: 1500}"}}) {
    ErrorList errors("scenario");
    std::set<std::filesystem::path> read;
    Node root = parse_tree(yaml, "scenario", errors, read);
    apply_overrides(root, std::vector{change}, "scenario.yaml", errors, read);
    const Node* const rotor = root.find("avoidance")->find("parameters")->find("main_rotor");
    ASSERT_NE(rotor->find("rpm"), nullptr) << yaml << " " << change;
    EXPECT_EQ(rotor->find("rpm")->text, "1500");
    EXPECT_TRUE(errors.empty());
  }
}

}  // namespace
}  // namespace hedgehop::sim
