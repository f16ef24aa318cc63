#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/vehicle.h"

namespace hedgehop::dynamics {
namespace {

struct Field {
  std::string_view unit = "";
  std::optional<double> above = {}, at_least = {}, below = {}, at_most = {};
  std::vector<std::string_view> choices = {};
  bool required = false;
  std::string_view selector = "type";
  std::string_view meaning = "";
};

/// Holds a map of a vehicle file against the values of a config.
class Comparison {
 public:
  Comparison(const YAML::Node& map, std::string path) : map_(map), path_(std::move(path)) { seen_.insert("type"); }

  template <class T>
  void operator()(std::string_view key, T& value, const Field& field) {
    const std::string name(key);
    seen_.insert(name);
    const YAML::Node node = map_[name];
    ASSERT_TRUE(node) << path_ + name << " is not in the file";
    const double scale = field.unit == "deg" ? std::numbers::pi / 180.0 : 1.0;
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int64_t>) {
      EXPECT_NEAR(node.template as<double>() * scale, static_cast<double>(value), 1e-12) << path_ + name;
    } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(node[i].template as<double>(), value[i], 1e-12) << path_ + name;
    } else if constexpr (std::is_enum_v<T>) {
      EXPECT_EQ(node.template as<std::string>(), field.choices[static_cast<size_t>(value)]) << path_ + name;
    } else if constexpr (std::is_same_v<T, FlybarConfig>) {
      std::visit(
          [&](auto& c) {
            EXPECT_EQ(node["type"].template as<std::string>(), c.kName);
            compare(node, path_ + name + ".", c);
          },
          value);
    } else {
      compare(node, path_ + name + ".", value);
    }
  }

  template <class T>
  static void compare(const YAML::Node& map, const std::string& path, T& config) {
    Comparison comparison(map, path);
    describe(comparison, config);
    for (const auto& entry : map) {
      const auto key = entry.first.as<std::string>();
      EXPECT_TRUE(comparison.seen_.contains(key)) << path + key << " is no key of a vehicle";
    }
  }

 private:
  YAML::Node map_;
  std::string path_;
  std::set<std::string> seen_;
};

TEST(VehicleFiles, HoldEveryKeyWithTheDefaultValues) {
  for (const char* file : {"xcell_60.yaml", "electric_helicopter_8kg.yaml"}) {
    const YAML::Node root = YAML::LoadFile(std::string(HEDGEHOP_SOURCE_DIR "/configs/vehicles/") + file);
    EXPECT_EQ(root["type"].as<std::string>(), HelicopterConfig::kName);
    HelicopterConfig config;
    Comparison::compare(root, std::string(file) + ": ", config);
  }
}

}  // namespace
}  // namespace hedgehop::dynamics
