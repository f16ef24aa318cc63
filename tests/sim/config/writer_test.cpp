#include "sim/config/outline_texts.h"

#include <gtest/gtest.h>

#include <bit>

#include "random_config.h"
#include "sample_config.h"
#include "sim/config/config_tree.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

/// A visitor that lists the bits of every value: an oracle without code of the writer.
class Bits {
 public:
  template <class T>
  void operator()(std::string_view, T& value, const fields::Field& field) {
    if constexpr (fields::NumberField<T>) {
      bits.push_back(std::bit_cast<uint64_t>(value));
    } else if constexpr (std::same_as<T, bool> || fields::IntegerField<T> || fields::ChoiceField<T>) {
      bits.push_back(static_cast<uint64_t>(value));
    } else if constexpr (std::same_as<T, std::string>) {
      bits.insert(bits.end(), value.begin(), value.end());
      bits.push_back(UINT64_MAX);
    } else if constexpr (std::same_as<T, std::filesystem::path>) {
      std::string text = value.string();
      (*this)("", text, field);
    } else if constexpr (fields::OptionalField<T>) {
      bits.push_back(value.has_value());
      if (value) (*this)("", *value, field);
    } else if constexpr (fields::EigenField<T> || fields::VectorField<T>) {
      bits.push_back(static_cast<uint64_t>(value.size()));
      for (auto& item : value) (*this)("", item, field);
    } else if constexpr (fields::OpenField<T>) {
      add(value);
    } else if constexpr (fields::SealedField<T>) {
      auto choice = value.choice();
      (*this)("", choice.module, field);
    } else if constexpr (fields::VariantField<T>) {
      bits.push_back(value.index());
      std::visit([&](auto& chosen) { describe(*this, chosen); }, value);
    } else {
      describe(*this, value);
    }
  }
  std::vector<uint64_t> bits;

 private:
  void add(const Node& node) {
    bits.insert(bits.end(), {static_cast<uint64_t>(node.kind), node.items.size(), node.entries.size()});
    bits.insert(bits.end(), node.text.begin(), node.text.end());
    for (const Node& item : node.items) add(item);
    for (const Entry& entry : node.entries) {
      bits.insert(bits.end(), entry.key.begin(), entry.key.end());
      add(entry.value);
    }
  }
};

template <class T>
std::vector<uint64_t> bits_of(T value) {
  Bits visitor;
  describe(visitor, value);
  return visitor.bits;
}

/// Writes, reads without validating, and compares bit for bit.
template <class T>
void expect_round_trip(const T& value, const std::string& what) {
  const std::string text = yaml_text(outline_fields(value));
  ErrorList faults("scenario");
  const Node root = parse_yaml(text, "round.yaml", faults);
  T back;
  read_struct(root, "", "", back, faults);
  ASSERT_NO_THROW(faults.throw_if_any()) << what << "\n" << text;
  ASSERT_EQ(bits_of(value), bits_of(back)) << what << "\n" << text;
}

TEST(Writer, DefaultsReadBack) {
  expect_round_trip(sample::Sample{}, "sample");
  expect_round_trip(Scenario{}, "scenario");
}

TEST(Writer, AnyConfigReadsBackBitForBit) {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    sample::Sample sample;
    Randomizer randomizer(seed);
    describe(randomizer, sample);
    expect_round_trip(sample, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST(Writer, AnyScenarioReadsBackBitForBit) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Scenario scenario;
    Randomizer randomizer(seed);
    describe(randomizer, scenario);
    expect_round_trip(scenario, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

/// Keys and unquoted texts of a foreign module that a list or map on one line would cut.
constexpr const char* kForeign = R"(
names:
  - a, b
  - what?
  - "[1]"
"x: y": 1
"null": 2
"a, b":
  - "q#": {c: 1}
    "d]": [3, 4]
dashes: [-, {e: -}, [-, --]]
plain: [http://a/b, 1.5]
two words: größe
)";

TEST(Writer, UninterpretedMapsReadBack) {
  ErrorList faults("scenario");
  const Node node = parse_yaml(kForeign, "foreign", faults);
  const auto bits_of_text = [&](const std::string& text) {
    Bits bits;
    Node back = parse_yaml(text, "back", faults);
    bits("", back, {});
    return bits.bits;
  };
  for (const std::string& text : {yaml_text(outline_as_written(node).parts), flow_text(node)}) {
    EXPECT_EQ(bits_of_text(text), bits_of_text(kForeign)) << text;
    EXPECT_EQ(text.find("\"plain"), std::string::npos);
    EXPECT_EQ(text.find("\"two words"), std::string::npos);
  }
  EXPECT_NE(yaml_text(outline_as_written(node).parts).find("plain: [http://a/b, 1.5]\ntwo words: größe\n"),
            std::string::npos);
  EXPECT_NO_THROW(faults.throw_if_any());
}

TEST(Writer, WritesPlainYaml) {
  sample::Sample sample;
  sample.rotors = {{2, 0.5}};
  const std::string text = yaml_text(outline_fields(sample));
  EXPECT_NE(text.find("rotors:\n  - blade_count: 2\n    radius: 0.5\n"), std::string::npos) << text;
  EXPECT_NE(text.find("gains: [1, 2]\nwords: []\nsize: [1, 2]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("delay: ~\n"), std::string::npos) << text;
  EXPECT_NE(text.find("shape:\n  type: round\n  radius: 1\n"), std::string::npos) << text;
}

TEST(Writer, ShippedScenariosReadBackBitForBit) {
  for (const auto& file : shipped_scenarios()) {
    const Scenario scenario = load_scenario(file);
    EXPECT_EQ(to_yaml(scenario).find("use:"), std::string::npos);
    expect_round_trip(scenario, file.string());
  }
}

}  // namespace
}  // namespace hedgehop::sim
