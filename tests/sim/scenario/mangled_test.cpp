#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

/// Damaged scenarios must load or be refused.
namespace hedgehop::sim {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Texts with a meaning in YAML.
constexpr std::string_view kYamlBits[] = {"[",
                                          "]",
                                          "{",
                                          "}",
                                          ":",
                                          "-",
                                          "\n",
                                          "  ",
                                          "#",
                                          "&a ",
                                          "*a",
                                          "<<: ",
                                          "~",
                                          ".nan",
                                          "'",
                                          "\"",
                                          "|",
                                          "\t",
                                          "use: a.yaml",
                                          "1e308",
                                          "-1",
                                          "!!str ",
                                          "---\n",
                                          "%",
                                          "\xff",
                                          std::string_view("\0", 1),
                                          "? ",
                                          "99999999999999999999",
                                          "module: go_to_goal"};

/// Bytes inserted, removed, changed or repeated.
TEST(MangledScenarios, MutatedScenariosLoadOrThrowInputError) {
  Folder folder;
  const std::string original = text_of(kConfigs / "garratt2009_city_0.yaml");
  for (const char* used : {"rigs/garratt2009_400.yaml", "sensors/day.yaml", "vehicles/electric_helicopter_8kg.yaml"}) {
    Folder::write(used, text_of(kConfigs / used));
  }
  std::mt19937_64 random(7);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 800; ++i) {
    std::string text = original;
    for (uint64_t edits = 1 + random() % 3; edits > 0; --edits) {
      const size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text.insert(at, kYamlBits[random() % std::size(kYamlBits)]);
          break;
        case 1:
          text.erase(at, random() % 12);
          break;
        case 2:
          text[at] = static_cast<char>(random() % 128);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 60));
          break;
      }
      if (text.empty()) text = "x";
    }
    Folder::write("a.yaml", text);
    try {
      load_scenario("a.yaml");
      ++loaded;
    } catch (const InputError& error) {
      ++refused;
      ASSERT_FALSE(error.errors().empty());
      for (const std::string& fault : error.errors()) {
        ASSERT_TRUE(fault.starts_with("a.yaml") || fault.starts_with("rigs/") || fault.starts_with("vehicles/"))
            << fault;
      }
    }
  }
  EXPECT_GT(loaded, 50);
  EXPECT_GT(refused, 300);
}

/// Every key of a whole scenario, each with values of every kind.
TEST(MangledScenarios, AnyValueForAnyKeyLoadsOrThrowsInputError) {
  Folder folder;
  Folder::write("whole.yaml", to_yaml(load_scenario(kConfigs / "garratt2009_city_0.yaml")));
  ErrorList faults("scenario");
  const Node root = load_tree("whole.yaml", faults);
  std::vector<std::string> paths;
  const std::function<void(const Node&, const std::string&)> collect = [&](const Node& node, const std::string& path) {
    if (!path.empty()) paths.push_back(path);
    for (size_t i = 0; i < node.items.size(); ++i) collect(node.items[i], join_path(path, std::to_string(i)));
    for (const Entry& entry : node.entries) collect(entry.value, join_path(path, entry.key));
  };
  collect(root, "");
  for (const std::string& path : paths) {
    for (const char* value : {"~", "-1", "0", "1e300", "x", "[]", "[1, 2, 3]", "{}", "{type: x}", ".inf", "7"}) {
      try {
        load_scenario("whole.yaml", std::vector<std::string>{path + "=" + value});
      } catch (const InputError& error) {
        ASSERT_FALSE(error.errors().empty());
      }
    }
  }
  EXPECT_GT(paths.size(), 100u);
}

}  // namespace
}  // namespace hedgehop::sim
