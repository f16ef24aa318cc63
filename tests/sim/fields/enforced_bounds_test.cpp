#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "avoidance/registry.h"
#include "dynamics/air/wind.h"
#include "dynamics/avionics.h"
#include "dynamics/vehicle.h"
#include "leaves.h"
#include "scenes/generators.h"
#include "sim/scenario/rig.h"

/// A bound is stated once, in describe(), and each library enforces exactly that: a value just outside is refused by
/// its key, one just inside is not.
namespace hedgehop {
namespace {

using fields::Edge;

/// Why `make` refuses, or "".
template <class Make>
std::string refusal_of(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

/// Sets each leaf of `config` to each of its edges and compares the result of `make` with its bounds.
/// @param make  takes a config with one leaf changed, and that leaf's key.
template <class Config, class Make>
int hold_to_bounds(const Config& config, std::string_view prefix, const Make& make) {
  int held = 0;
  for (const Edge edge : fields::kEdges) {
    size_t count = 1;
    for (size_t leaf = 0; leaf < count; ++leaf) {
      Config changed = config;
      fields::LeafSetter setter(leaf, edge);
      setter(prefix, changed, {});
      count = setter.count();
      if (setter.key().empty()) continue;
      ++held;
      const std::string said = refusal_of([&] { make(changed, setter.key()); });
      // A message that names another field states a relation, not a bound.
      const bool by_bound =
          said.find(setter.key() + ": must be ") != std::string::npos && said.find(" than '") == std::string::npos;
      EXPECT_EQ(by_bound, !is_inside(edge)) << setter.key() << " at edge " << static_cast<int>(edge) << ": " << said;
    }
  }
  return held;
}

/// The same for every combination of a config's alternatives. @return how many edges were tried.
template <class Config, class Make>
int hold_all(const Make& make) {
  int held = 0;
  fields::for_each_filled<Config>([&](const Config& config) { held += hold_to_bounds(config, "", make); });
  return held;
}

TEST(EnforcedBounds, OfScenes) {
  const auto make = [](scenes::SceneConfig config, const std::string& key) {
    // A size that every generator refuses once the bounds hold: no scene is painted in vain.
    constexpr int64_t kLargestPx = 2048, kNoPowerOfTwo = 2047;
    std::visit(
        [&](auto& chosen) {
          if constexpr (requires { chosen.texture_size_px; }) {
            if (key != "texture_size" || chosen.texture_size_px == kLargestPx) chosen.texture_size_px = kNoPowerOfTwo;
          }
        },
        config);
    scenes::make_scene(config, 1);
  };
  EXPECT_GT(hold_all<scenes::SceneConfig>(make), 1000);
}

TEST(EnforcedBounds, OfVehicles) {
  const auto make = [](const dynamics::VehicleConfig& config, const std::string&) { dynamics::Vehicle{config}; };
  EXPECT_GT(hold_all<dynamics::VehicleConfig>(make), 400);
}

TEST(EnforcedBounds, OfTheWind) {
  const auto make = [](const dynamics::air::WindConfig& config, const std::string&) { dynamics::air::Wind(config, 1); };
  EXPECT_GT(hold_all<dynamics::air::WindConfig>(make), 20);
}

TEST(EnforcedBounds, OfAvionics) {
  const dynamics::VehicleConfig vehicle;
  const auto make = [&](dynamics::AvionicsConfig config, const std::string&) {
    constexpr double kPhysicsDtS = 0.002;
    dynamics::Avionics(config, vehicle, kPhysicsDtS, [](std::string_view) { return uint64_t{1}; });
  };
  EXPECT_GT(hold_all<dynamics::AvionicsConfig>(make), 150);
}

TEST(EnforcedBounds, OfCameras) {
  const auto make = [](const sim::CameraConfig& config, const std::string&) { config.model(); };
  EXPECT_GT(hold_all<sim::CameraConfig>(make), 50);
}

TEST(EnforcedBounds, OfModules) {
  const auto make = [](const avoidance::ModuleConfig& config, const std::string&) { avoidance::make_module(config); };
  EXPECT_GT(hold_all<avoidance::ModuleConfig>(make), 300);
}

}  // namespace
}  // namespace hedgehop
