#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dynamics/helicopter/trim.h"
#include "dynamics/vehicle.h"
#include "tests/dynamics/control/closed_loop.h"

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

template <class T>
constexpr bool kIsVariant = false;
template <class... T>
constexpr bool kIsVariant<std::variant<T...>> = true;

/// Compares a map of a vehicle file with the values of a config.
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
    } else if constexpr (kIsVariant<T>) {
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

/// Reads a map of a vehicle file into a config.
class Reader {
 public:
  explicit Reader(const YAML::Node& map) : map_(map) {}

  template <class T>
  void operator()(std::string_view key, T& value, const Field& field) {
    const YAML::Node node = map_[std::string(key)];
    ASSERT_TRUE(node) << key << " is not in the file";
    const double scale = field.unit == "deg" ? std::numbers::pi / 180.0 : 1.0;
    if constexpr (std::is_same_v<T, double>) {
      value = node.template as<double>() * scale;
    } else if constexpr (std::is_same_v<T, int64_t>) {
      value = node.template as<int64_t>();
    } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
      for (int i = 0; i < 3; ++i) value[i] = node[i].template as<double>();
    } else if constexpr (std::is_enum_v<T>) {
      const auto found = std::find(field.choices.begin(), field.choices.end(), node.template as<std::string>());
      ASSERT_NE(found, field.choices.end()) << key;
      value = static_cast<T>(found - field.choices.begin());
    } else if constexpr (kIsVariant<T>) {
      read_choice(node, value);
    } else {
      Reader reader(node);
      describe(reader, value);
    }
  }

 private:
  template <class... A>
  static void read_choice(const YAML::Node& node, std::variant<A...>& value) {
    const auto read_if_named = [&]<class T>() {
      if (node["type"].as<std::string>() != T::kName) return false;
      T config;
      Reader reader(node);
      describe(reader, config);
      value = config;
      return true;
    };
    EXPECT_TRUE((read_if_named.template operator()<A>() || ...));
  }

  YAML::Node map_;
};

helicopter::HelicopterConfig read(const std::string& file) {
  const YAML::Node root = YAML::LoadFile(HEDGEHOP_SOURCE_DIR "/configs/vehicles/" + file + ".yaml");
  helicopter::HelicopterConfig config;
  Reader reader(root);
  describe(reader, config);
  Comparison::compare(root, file + ": ", config);  // no additional keys
  return config;
}

TEST(VehicleFiles, HoldEveryKeyWithTheDefaultValues) {
  for (const char* file : {"xcell_60.yaml", "electric_helicopter_8kg.yaml"}) {
    const YAML::Node root = YAML::LoadFile(std::string(HEDGEHOP_SOURCE_DIR "/configs/vehicles/") + file);
    EXPECT_EQ(root["type"].as<std::string>(), helicopter::HelicopterConfig::kName);
    helicopter::HelicopterConfig config;
    Comparison::compare(root, std::string(file) + ": ", config);
  }
}

struct Flier {
  std::string file;
  double cruise_mps;
};
class HelicopterFiles : public testing::TestWithParam<Flier> {};
INSTANTIATE_TEST_SUITE_P(Vehicles, HelicopterFiles,
                         testing::Values(Flier{"xcell_60", 16.0}, Flier{"helion", 14.0}, Flier{"artis", 14.0},
                                         Flier{"gtmax", 18.0}),
                         [](const auto& flier) { return flier.param.file; });

// Check HT4, for any helicopter.
TEST_P(HelicopterFiles, HT4_TrimFromRearwardFlightToCruise) {
  const helicopter::HelicopterConfig config = read(GetParam().file);
  const helicopter::HelicopterModel model = make_model(config);
  double pitch = 1e9, least_w = 1e9, hover_w = 0.0, cruise_w = 0.0;
  for (double V = -4.0; V <= GetParam().cruise_mps; V += 1.0) {
    SCOPED_TRACE(V);
    const std::optional<helicopter::Trim> t = trim(model, {V, 0.0, 0.0});
    ASSERT_TRUE(t);
    EXPECT_TRUE(t->loads.main_rotor.inflow.within_momentum_theory);
    EXPECT_LT(t->loads.main_rotor.inflow.thrust_n, 0.9 * model.main_rotor.disc.max_thrust_n);
    EXPECT_LT(t->pitch_rad, pitch);
    const auto within = [](const helicopter::ServoConfig& servo, double angle) {
      return angle > servo.lowest_rad && angle < servo.highest_rad;
    };
    EXPECT_TRUE(within(config.servos.collective, t->blades.collective_rad)) << t->blades.collective_rad;
    EXPECT_TRUE(within(config.servos.cyclic, t->blades.lateral_rad)) << t->blades.lateral_rad;
    EXPECT_TRUE(within(config.servos.cyclic, t->blades.longitudinal_rad)) << t->blades.longitudinal_rad;
    EXPECT_TRUE(within(config.servos.tail, t->blades.tail_rad)) << t->blades.tail_rad;
    const double power_w = t->loads.main_rotor.power_w;
    pitch = t->pitch_rad;
    least_w = std::min(least_w, power_w);
    cruise_w = power_w;
    if (V == 0.0) {
      hover_w = power_w;
      EXPECT_GT(t->roll_rad, 2.0 * std::numbers::pi / 180.0) << "clockwise rotors hover right side down";
      EXPECT_LT(t->roll_rad, 5.0 * std::numbers::pi / 180.0);
    }
  }
  EXPECT_LT(least_w, hover_w);
  EXPECT_LT(least_w, cruise_w);
}

// Checks LM6 and LM7, for any helicopter.
TEST_P(HelicopterFiles, LM6_HeaveDampingLiesInThePublishedBand) {
  using L = helicopter::LinearModel;
  const helicopter::HelicopterModel model = make_model(read(GetParam().file));
  const helicopter::LinearModel m = linearize(model, *trim(model, Eigen::Vector3d::Zero()));
  EXPECT_LT(m.A(L::kW, L::kW), -0.4);
  EXPECT_GT(m.A(L::kW, L::kW), -1.0);
  EXPECT_LT(m.A(L::kP, L::kV), 0.0);
  EXPECT_LT(m.A(L::kR, L::kR), 0.0);
  EXPECT_GT(m.A(L::kR, L::kV), 0.0);
}

TEST_P(HelicopterFiles, AutopilotSettlesOnAVelocityStep) {
  Loop loop;
  loop.vehicle = read(GetParam().file);
  loop.perfect = true;
  constexpr double kStepMps = 3.0;
  const std::vector<Sample> flight = fly(loop, 16.0, [](double t_s) {
    return control::VelocitySetpoint{{t_s < 1.0 ? 0.0 : kStepMps, 0.0}, 10.0, 0.0};
  });
  double overshoot = 0.0;
  for (const Sample& s : flight) {
    const Eigen::Vector3d v = s.v_WB_W();
    overshoot = std::max(overshoot, v.x() / kStepMps - 1.0);
    EXPECT_NEAR(s.body.p_WB.z(), -10.0, 0.5) << s.t_s;
    if (s.t_s > 8.0) {
      EXPECT_NEAR(v.x(), kStepMps, 0.05 * kStepMps) << s.t_s;
      EXPECT_NEAR(v.y(), 0.0, 0.05 * kStepMps) << s.t_s;
    }
  }
  EXPECT_LT(overshoot, 0.2);
}

}  // namespace
}  // namespace hedgehop::dynamics
