#include "sim/loop/flight_environment.h"

#include <optional>
#include <utility>

#include "sim/render/haze.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

/// Returns the scene in air of the scenario's visibility; the sky is seen through a kilometer of that air.
scenes::Scene visible_scene(const Scenario& scenario, scenes::SceneFiles files) {
  scenes::Scene scene =
      build_part("scene", [&] { return build_scene(scenario.scene, scenario.world(), std::move(files)); });
  if (const std::optional<double>& visibility_m = scenario.drawing.visibility_m) {
    constexpr double kSkyPathM = 1000.0;
    scene.sky.visibility_m = *visibility_m;
    const auto seen = static_cast<float>(transmittance(kSkyPathM, *visibility_m));
    scene.sky.zenith = scene.sky.horizon + seen * (scene.sky.zenith - scene.sky.horizon);
  }
  return scene;
}

}  // namespace

FlightEnvironment::FlightEnvironment(const Scenario& scenario)
    : FlightEnvironment(scenario,
                        build_part("scene", [&] { return read_scene_files(scenario.scene, scenario.world()); })) {}

FlightEnvironment::FlightEnvironment(const Scenario& scenario, scenes::SceneFiles files)
    : scene(std::make_shared<const scenes::Scene>(visible_scene(scenario, std::move(files)))),
      hull(dynamics::hull(scenario.vehicle)),
      collision(*scene, hull),
      renderer(*scene, Culling::frustum_and_horizon, scenario.drawing.renderer,
               scenario.drawing.shadows ? Shadows::sun : Shadows::none) {}

}  // namespace hedgehop::sim
