#include "sim/config/outline_texts.h"

#include <gtest/gtest.h>

#include <functional>

#include "json_schema_check.h"
#include "random_config.h"
#include "sample_config.h"
#include "sim/config/config_tree.h"
#include "sim/scenario/list_topics.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

std::string fault_of(const Json& schema, const std::string& yaml) {
  return schema_fault(schema, schema, json_of(YAML::Load(yaml)));
}

class Schema : public testing::Test {
 protected:
  const Json scenario_ = Json::parse(json_schema());
  const Json sample_ = Json::parse(schema_text(outline_fields(sample::Sample{}), "sample"));
};

TEST_F(Schema, AcceptsEveryShippedScenarioAsWrittenAndResolved) {
  for (const auto& file : shipped_scenarios()) {
    EXPECT_EQ(schema_fault(scenario_, scenario_, json_of(YAML::LoadFile(file))), "") << file;
    EXPECT_EQ(fault_of(scenario_, to_yaml(load_scenario(file))), "") << file;
  }
}

TEST_F(Schema, AcceptsWhateverTheWriterWrites) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    sample::Sample sample;
    Randomizer randomizer(seed);
    describe(randomizer, sample);
    const std::string text = yaml_text(outline_fields(sample));
    ASSERT_EQ(fault_of(sample_, text), "") << text;
  }
}

TEST_F(Schema, RefusesFilesThatTheReaderRefuses) {
  const std::vector<std::string> bad = {"mas: 3",
                                        "mass: 0",
                                        "mass: 100",
                                        "mass: x",
                                        "mass: ~",
                                        "whole: 3.5",
                                        "seed: -1",
                                        "on: 1",
                                        "color: gray",
                                        "rotor: {blade_count: 0}",
                                        "rotor: {blades: 3}",
                                        "rotor: ~",
                                        "gains: [-1]",
                                        "gains: 3",
                                        "size: [1]",
                                        "size: [1, 2, 3]",
                                        "shape: {type: square}",
                                        "shape: {radius: 3}",
                                        "shape: {type: round, side: 3}",
                                        "shapes: [{type: round}]",
                                        "tail: {blade_count: x}",
                                        "delay: -1"};
  for (const std::string& text : bad) {
    ErrorList faults("scenario");
    sample::Sample sample;
    read_struct(parse_yaml(text, "bad.yaml", faults), "", "", sample, faults);
    EXPECT_FALSE(faults.empty()) << text;
    EXPECT_NE(fault_of(sample_, text), "") << text;
  }
  EXPECT_EQ(fault_of(sample_, "shape: {use: a.yaml, side: 3}"), "");
  EXPECT_EQ(fault_of(sample_, "{use: a.yaml, shape: {side: 3}}"), "");
  EXPECT_NE(fault_of(sample_, "{use: a.yaml, shape: {sides: 3}}"), "");
  EXPECT_NE(fault_of(scenario_, "name: x"), "") << "scene and more are required";
}

TEST_F(Schema, SaysUnitBoundsAndDefaultOfAKey) {
  const Json& tilt = sample_["else"]["properties"]["tilt"];
  EXPECT_EQ(tilt["description"], "tilt [deg]");
  EXPECT_EQ(tilt["minimum"], -60);
  EXPECT_NEAR(tilt["default"].get<double>(), 20.053522829578810, 1e-12);
}

TEST_F(Schema, FaultOfAChoiceNamesItsKey) {
  EXPECT_EQ(fault_of(sample_, "{mass: 1, shape: {type: round, radios: 3}}"), "$.shape: unknown radios");
  EXPECT_EQ(fault_of(sample_, "{mass: 1, shape: {type: rond}}"),
            "$.shape.type: enum [\"round\",\"square\"], got \"rond\"");
}

TEST_F(Schema, HoldsEachDefinitionOnce) {
  EXPECT_LT(json_schema().size(), 400'000u);
  EXPECT_FALSE(scenario_.at("$defs").empty());
}

/// Each selector must be known to the rule by which a laid-over choice replaces a map, and no field may bear its name,
/// but in a choice that another key identifies: there, too, another name makes another choice.
TEST(Selectors, AreTheOnesThatLayingOverKnows) {
  const std::vector<std::string_view> known(std::begin(kSelectors), std::end(kSelectors));
  const auto is_known = [&](std::string_view key) { return std::find(known.begin(), known.end(), key) != known.end(); };
  const std::function<void(const std::vector<ConfigOutline>&)> look = [&](const std::vector<ConfigOutline>& nodes) {
    for (const ConfigOutline& node : nodes) {
      EXPECT_FALSE(is_known(node.key)) << node.key;
      if (node.kind != ConfigOutline::Kind::variant && node.chosen_by_key) continue;
      if (node.kind == ConfigOutline::Kind::variant) {
        EXPECT_TRUE(is_known(node.field.selector)) << node.field.selector;
      }
      look(node.parts);
      look(node.item);
      look(node.all);
    }
  };
  look(outline_fields(Scenario{}));
}

TEST(Document, ListsEveryChoiceWithItsKeys) {
  EXPECT_EQ(describe_choices<sample::Shape>(),
            "round: a disc\n"
            "    radius  radius  (number m, > 0, default 1)\n"
            "\n"
            "square: a square\n"
            "    side  side  (number m, > 0, required)\n");
  for (const std::string& topic : document_topics()) EXPECT_FALSE(document(topic).empty()) << topic;
  EXPECT_NE(document("modules").find("flow_balance: "), std::string::npos);
  EXPECT_EQ(
      faults_of([] { document("scene"); }),
      std::vector<std::string>{"unknown topic 'scene'; did you mean 'scenes'? allowed: modules, vehicles, scenes, "
                               "cameras, checks, scenario"});
}

/// Every key of a user has a description.
TEST(Document, EveryFieldOfAScenarioHasAMeaning) {
  const std::function<void(const std::vector<ConfigOutline>&, const std::string&)> look =
      [&](const std::vector<ConfigOutline>& nodes, const std::string& path) {
        for (const ConfigOutline& node : nodes) {
          const std::string here = join_path(path, node.key);
          if (!node.key.empty()) {
            EXPECT_FALSE(node.field.meaning.empty() && node.meaning.empty()) << here;
          }
          look(node.parts, here);
          look(node.item, here);
          look(node.all, here);
        }
      };
  look(outline_fields(Scenario{}), "");
}

}  // namespace
}  // namespace hedgehop::sim
